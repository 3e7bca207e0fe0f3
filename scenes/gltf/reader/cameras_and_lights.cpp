#include "scenes/gltf/reader/cameras_and_lights.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/io/input_error.h"
#include "scenes/gltf/tinygltf.h"

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

using Eigen::Vector3d;

glm::dvec3 ColorOf(const tinygltf::Light& light) {
  if (light.color.size() != 3) return glm::dvec3(1.0);
  return {light.color[0], light.color[1], light.color[2]};
}

// The node's +z axis, from where the light comes; a unit vector keeps its bits.
std::optional<Vector3d> Backwards_W(const PlacedNode& placed) {
  constexpr double kUnitTolerance = 1e-12;
  const Vector3d z_W = placed.M_WN.block<3, 1>(0, 2);
  const double length = z_W.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return std::abs(length - 1.0) < kUnitTolerance ? z_W : Vector3d(z_W / length);
}

Sun ReadSun(const tinygltf::Light& light, const Vector3d& direction_W) {
  const Vector3d& d = direction_W;
  return {.azimuth_rad = std::atan2(d.x(), d.z()),
          .elevation_rad = std::atan2(d.y(), std::hypot(d.x(), d.z())),
          // Rec. 709 luminance; the sun has no colour of its own.
          .illuminance_lx =
              light.intensity * glm::dot(ColorOf(light), glm::dvec3(0.2126, 0.7152, 0.0722))};
}

Lamp ReadLamp(const tinygltf::Light& light, const PlacedNode& placed, const std::string& name,
              const Vector3d& backwards_W) {
  Lamp lamp;
  lamp.name = name;
  lamp.p_WL = placed.M_WN.topRightCorner<3, 1>();
  lamp.intensity_rgb = ColorOf(light) * light.intensity;
  lamp.irradiance_830_per_lux =
      NumberOr(Find(light.extras, {"fenestra", "irradiance_830_per_lux"}), 0.0);
  if (light.type == "spot") {
    lamp.cone = {.axis_W = -backwards_W,
                 .inner_rad = light.spot.innerConeAngle,
                 .outer_rad = std::min(light.spot.outerConeAngle, 0.5 * std::numbers::pi)};
  }
  return lamp;
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

Lights ReadLights(const Asset& asset, const std::vector<PlacedNode>& nodes, Notes& notes) {
  Lights lights;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = asset.model.nodes[placed.node];
    const tinygltf::Value* reference = Extension(node.extensions, "KHR_lights_punctual");
    if (reference == nullptr || !placed.is_visible) continue;
    const auto index = static_cast<size_t>(NumberOr(Find(*reference, {"light"}), 0.0));
    const tinygltf::Light& light = asset.model.lights[index];
    const std::string name = node.name.empty() ? light.name : node.name;
    const std::string thing = Named("light", name, index);
    const auto backwards_W = Backwards_W(placed);
    if (light.type != "point" && !backwards_W) {
      notes.Add("a light without a direction is left out", thing);
    } else if (light.type != "directional") {
      if (light.range > 0.0) notes.Add("its light has no range here", thing);
      lights.lamps.push_back(
          ReadLamp(light, placed, name, backwards_W.value_or(Vector3d::UnitZ())));
    } else if (lights.sun) {
      notes.Add("a second directional light is left out", thing);
    } else {
      lights.sun = ReadSun(light, *backwards_W);
      if (ColorOf(light) != glm::dvec3(1.0)) notes.Add("the sun's colour is left out", thing);
    }
  }
  return lights;
}

}  // namespace fenestra::gltf
