#include "scenes/gltf/writer/gltf_writer.h"

#include <fmt/format.h>

#include <limits>
#include <sstream>
#include <utility>

#include "core/io/input_error.h"
#include "core/io/input_file.h"
#include "core/io/temporary_files.h"
#include "scenes/gltf/writer/material_writer.h"
#include "scenes/gltf/writer/node_writer.h"

namespace fenestra {
namespace {

// Puts all that has been written below a node at the place that the world has in the file.
void MoveToFile(const Eigen::Vector3d& p_FW, tinygltf::Model& model) {
  if (p_FW.isZero(0.0) || model.nodes.empty()) return;
  tinygltf::Node root;
  root.name = "world";
  root.translation = {p_FW.x(), p_FW.y(), p_FW.z()};
  root.children = std::exchange(model.scenes[0].nodes, {static_cast<int>(model.nodes.size())});
  model.nodes.push_back(std::move(root));
}

tinygltf::Model ToModel(const GltfScene& gltf) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "Fenestra";
  model.scenes.emplace_back();
  model.defaultScene = 0;
  gltf::BufferBuilder buffer(model);
  gltf::WriteTextures(gltf.scene, model, buffer);
  gltf::WriteMaterials(gltf.scene, model);
  gltf::WriteMeshes(gltf.scene, model, buffer);
  gltf::WriteWindows(gltf.scene, model);
  gltf::WriteCameras(gltf.cameras, model);
  gltf::WriteLights(gltf, model);
  MoveToFile(gltf.p_FW, model);
  if (model.buffers[0].data.empty()) model.buffers.clear();
  if (model.nodes.empty()) {  // tinygltf would write an empty scene as null.
    model.scenes.clear();
    model.defaultScene = -1;
  }
  return model;
}

}  // namespace

void WriteGltf(const OutputPath& file, const GltfScene& scene) {
  const std::string extension = LowerExtension(file.path());
  if (extension != ".gltf" && extension != ".glb") {
    throw InputError(file.path(),
                     fmt::format("a scene is written as .gltf or .glb, not as '{}'", extension));
  }
  Validate(scene.scene);
  tinygltf::Model model = ToModel(scene);
  // The lengths in a .glb have 32 bits; the JSON around the data is small.
  constexpr size_t kMostBytes = std::numeric_limits<uint32_t>::max() - (size_t{64} << 20);
  if (!model.buffers.empty() && model.buffers[0].data.size() > kMostBytes) {
    throw InputError(file.path(), "the scene has more data than a glTF file can hold");
  }
  std::ostringstream stream;
  const bool is_binary = extension == ".glb";
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, !is_binary, is_binary);
  WriteFileAtomically(file, stream.str());
}

}  // namespace fenestra
