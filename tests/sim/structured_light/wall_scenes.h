#pragma once

#include "scenes/targets/flat_targets.h"
#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra::testing {

inline Scene WhiteWall() {
  PaperTargetOptions options;
  options.with_target = false;
  return MakePaperTarget(options);
}

/// A box of the given half width whose front face stands `stand_off_m` before a large wall.
inline Scene BoxBeforeWall(double half_width_m, double stand_off_m) {
  Scene scene = WhiteWall();
  const float h = static_cast<float>(half_width_m);
  const float z = static_cast<float>(stand_off_m);
  scene.meshes.push_back({.name = "plate",
                          .positions_W = {{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}},
                          .material = scene.meshes.front().material});
  return scene;
}

inline StructuredLightOptions Noiseless() {
  StructuredLightOptions options;
  options.parametric.fixed_disparity_noise_px = 0.0;
  options.parametric.temporal_disparity_noise_px = 0.0;
  return options;
}

}  // namespace fenestra::testing
