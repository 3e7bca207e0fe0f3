#include "scenes/gltf/reader/cameras.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/io/input_error.h"
#include "scenes/gltf/file/values.h"

namespace fenestra::gltf {
namespace {

// Aspect ratio of a camera that does not state one: that of most sensors.
constexpr double kUsualAspectRatio = 4.0 / 3.0;

CameraModel FromExtras(const tinygltf::Value& ours) {
  const auto number = [&ours](const char* name) { return NumberOr(Find(ours, {name}), 0.0); };
  CameraParameters p{.width_px = static_cast<int>(number("width_px")),
                     .height_px = static_cast<int>(number("height_px")),
                     .fx_px = number("fx_px"),
                     .fy_px = number("fy_px"),
                     .cx_px = number("cx_px"),
                     .cy_px = number("cy_px"),
                     .distortion = {}};
  if (const tinygltf::Value* d = Find(ours, {"distortion"})) {
    const auto k = [d](int i) { return d->Get(i).GetNumberAsDouble(); };
    p.distortion = {.k1 = k(0), .k2 = k(1), .p1 = k(2), .p2 = k(3), .k3 = k(4)};
  }
  return CameraModel(p);
}

// yfov spans the whole image: h / 2 = f tan(yfov / 2).
CameraModel FromFieldOfView(const tinygltf::PerspectiveCamera& camera, int height_px) {
  const double aspect = camera.aspectRatio > 0.0 ? camera.aspectRatio : kUsualAspectRatio;
  // CameraModel refuses larger sizes; up to its limit the conversion to int is safe.
  const double width_px = std::min(std::round(height_px * aspect), 1e6);
  return CameraModel::Pinhole(static_cast<int>(width_px), height_px,
                              0.5 * height_px / std::tan(0.5 * camera.yfov));
}

}  // namespace

std::vector<SceneCamera> ReadCameras(const Asset& asset, const std::vector<PlacedNode>& nodes,
                                     int height_px, Notes& notes) {
  std::vector<SceneCamera> cameras;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = asset.model.nodes[placed.node];
    if (node.camera < 0) continue;
    const auto index = static_cast<size_t>(node.camera);
    const tinygltf::Camera& source = asset.model.cameras[index];
    const std::string name = node.name.empty() ? source.name : node.name;
    const std::string thing = Named("camera", name, index);
    const auto rigid = RigidPart(placed.M_WN);
    const tinygltf::Value* ours = Find(source.extras, {"fenestra"});
    if (ours == nullptr && source.type != "perspective") {
      notes.Add("an orthographic camera is left out", thing);
    } else if (ours == nullptr && !(source.perspective.yfov < std::numbers::pi)) {
      notes.Add("a field of view of 180 degrees or more is left out", thing);
    } else if (!rigid) {
      notes.Add("a sheared or mirrored camera is left out", thing);
    } else {
      try {
        cameras.push_back({.name = name,
                           .X_WC = FlipCameraAxes(rigid->X_WN),
                           .model = ours != nullptr
                                        ? FromExtras(*ours)
                                        : FromFieldOfView(source.perspective, height_px)});
      } catch (const InputError& error) {
        throw InputError(asset.file, fmt::format("/cameras/{}: {}", index, error.what()));
      }
    }
  }
  return cameras;
}

}  // namespace fenestra::gltf
