#include <fmt/format.h>

#include "scenes/gltf/validation/structure_check.h"

namespace fenestra::gltf {
namespace {

using nlohmann::json;

void CheckCamera(const json& camera, const std::string& at, Faults& faults) {
  const auto type = camera["type"].get<std::string>();
  const std::string other = type == "perspective" ? "orthographic" : "perspective";
  if (!camera.contains(type)) faults.Add(at, fmt::format("'{}' is missing", type));
  if (camera.contains(other)) {
    faults.Add(at + "/" + other, fmt::format("must not stand in a camera of type {}", type));
  }
  if (camera.contains("orthographic")) {
    for (const char* name : {"xmag", "ymag"}) {
      if (camera["orthographic"][name].get<double>() != 0.0) continue;
      faults.Add(fmt::format("{}/orthographic/{}", at, name), "must not be 0");
    }
  }
  if (camera.contains(type) && camera[type].contains("zfar")) {
    const auto near = camera[type]["znear"].get<double>();
    const auto far = camera[type]["zfar"].get<double>();
    if (!(far > near)) {
      faults.Add(fmt::format("{}/{}/zfar", at, type),
                 fmt::format("{} is not beyond znear, {}", far, near));
    }
  }
}

void CheckLight(const json& light, const std::string& at, Faults& faults) {
  if (light["type"] != "spot") return;
  if (!light.contains("spot")) return faults.Add(at, "'spot' is missing");
  const double inner = light["spot"].value("innerConeAngle", 0.0);
  const double outer = light["spot"].value("outerConeAngle", 0.7853981633974483);
  if (inner < outer) return;
  faults.Add(at + "/spot",
             fmt::format("innerConeAngle {} is not less than outerConeAngle {}", inner, outer));
}

}  // namespace

void CheckCamerasAndLights(const json& root, Faults& faults) {
  if (root.contains("cameras")) {
    for (size_t i = 0; i < root["cameras"].size(); ++i) {
      CheckCamera(root["cameras"][i], fmt::format("/cameras/{}", i), faults);
    }
  }
  const json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
  if (!root.contains(lights)) return;
  for (size_t i = 0; i < root[lights].size(); ++i) {
    CheckLight(root[lights][i], fmt::format("{}/{}", lights.to_string(), i), faults);
  }
}

void CheckAnimations(const json& root, Faults& faults) {
  if (!root.contains("animations")) return;
  for (size_t i = 0; i < root["animations"].size(); ++i) {
    const json& animation = root["animations"][i];
    const size_t samplers = animation["samplers"].size();
    for (size_t k = 0; k < animation["channels"].size(); ++k) {
      const auto sampler = animation["channels"][k]["sampler"].get<size_t>();
      if (sampler < samplers) continue;
      faults.Add(fmt::format("/animations/{}/channels/{}/sampler", i, k),
                 fmt::format("{} does not exist; there are {}", sampler, samplers));
    }
  }
}

}  // namespace fenestra::gltf
