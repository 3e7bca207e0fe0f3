#include "scenes/gltf/reader/gltf_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/faults.h"
#include "scenes/gltf/file/document.h"
#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/cameras_and_lights.h"
#include "scenes/gltf/reader/cost.h"
#include "scenes/gltf/reader/images.h"
#include "scenes/gltf/reader/materials.h"
#include "scenes/gltf/reader/meshes.h"
#include "scenes/gltf/reader/origin.h"
#include "scenes/gltf/reader/placement.h"
#include "scenes/gltf/reader/windows.h"

namespace fenestra {
namespace {

void NoteWhatIsIgnored(const gltf::Asset& asset, gltf::Notes& notes) {
  for (const std::string& extension : asset.ignored_extensions) {
    notes.Add("the extension is not supported and left out", extension);
  }
  for (size_t i = 0; i < asset.model.animations.size(); ++i) {
    notes.Add("nothing moves; all stands as it does at rest",
              gltf::Named("animation", asset.model.animations[i].name, i));
  }
}

// Faults of the scene that no earlier check has found, such as a position beyond single precision.
void CheckScene(const std::filesystem::path& file, const Scene& scene) {
  try {
    Validate(scene);
  } catch (const InputError& error) {
    Faults faults(file.string());
    for (const InputFault& fault : error.faults()) faults.Add(fault.message);
    faults.ThrowIfAny();
  }
}

}  // namespace

GltfScene ReadGltf(const std::filesystem::path& file, const GltfReadOptions& options) {
  const gltf::Asset asset = gltf::LoadAsset(file, options);
  Faults faults(file.string(), gltf::kMostFaults);
  gltf::CheckImages(asset, faults);
  faults.ThrowIfAny();

  gltf::Notes notes;
  NoteWhatIsIgnored(asset, notes);
  std::vector<gltf::PlacedNode> nodes = gltf::PlaceNodes(asset, options.scene_index);
  const size_t bytes_left = gltf::CheckCost(asset, nodes, options);
  const Eigen::Vector3d p_FW = gltf::ChooseOrigin(asset, nodes, options.target_node, notes);
  nodes = gltf::MovedTo(p_FW, std::move(nodes));
  gltf::ReadMaterials materials = gltf::ConvertMaterials(
      asset, std::min(options.max_image_pixels, bytes_left / gltf::kBytesPerTexel), notes);
  gltf::PlacedMeshes meshes = gltf::PlaceMeshes(asset, nodes, materials.materials, notes);
  gltf::Windows windows = gltf::FindWindows(asset, nodes, meshes, options.target_node);
  gltf::Lights lights = gltf::ReadLights(asset, nodes, notes);

  GltfScene result;
  result.p_FW = p_FW;
  result.cameras = gltf::ReadCameras(asset, nodes, options.camera_height_px, notes);
  result.sun = lights.sun;
  Scene& scene = result.scene;
  for (gltf::ReadMaterial& read : materials.materials) {
    scene.materials.push_back(std::move(read.material));
  }
  const size_t no_material = scene.materials.size();
  if (std::ranges::any_of(meshes.meshes,
                          [&](const Mesh& m) { return m.material == no_material; })) {
    scene.materials.push_back(gltf::DefaultMaterial());
  }
  scene.meshes = std::move(meshes.meshes);
  scene.textures = std::move(materials.textures);
  scene.lamps = std::move(lights.lamps);
  scene.target = windows.target;
  scene.other_windows = std::move(windows.others);
  if (scene.meshes.empty()) notes.Add("there is nothing to see in it", "the scene");
  result.notes = notes.Sentences();
  CheckScene(file, scene);
  return result;
}

}  // namespace fenestra
