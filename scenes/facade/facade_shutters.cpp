#include "scenes/facade/facade_shutters.h"

#include <cmath>

#include "scenes/mesh/solid_bodies.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

constexpr double kHinge_m = 0.02;          // From the opening's side to the leaf.
constexpr double kLeafClearance_m = 0.03;  // Between wall and leaf.
constexpr double kThickness_m = 0.03;
constexpr double kRim_m = 0.06;
constexpr double kSlatPitch_m = 0.06;
constexpr double kLeafSlatThickness_m = 0.006;
const double kSlatTilt_rad = std::numbers::pi / 4.0;

// Slats that slope outwards and down, and end in the rim.
void AddSlats(const Box& hole, Mesh& mesh) {
  const Vector3d centre = 0.5 * (hole.low + hole.high);
  const double height_m = hole.high.y() - hole.low.y();
  const int count = static_cast<int>(std::floor(height_m / kSlatPitch_m));
  // As deep as the leaf once it is tilted.
  const double depth_m =
      (kThickness_m - kLeafSlatThickness_m * std::sin(kSlatTilt_rad)) / std::cos(kSlatTilt_rad);
  const Vector3d along(0.5 * (hole.high.x() - hole.low.x()), 0.0, 0.0);
  const Vector3d out(0.0, -std::sin(kSlatTilt_rad), std::cos(kSlatTilt_rad));
  const Vector3d up(0.0, std::cos(kSlatTilt_rad), std::sin(kSlatTilt_rad));
  for (int i = 0; i < count; ++i) {
    const double y = hole.low.y() + height_m * (i + 0.5) / count;
    AddCuboid({.centre_W = {centre.x(), y, centre.z()},
               .half_x = along,
               .half_y = 0.5 * kLeafSlatThickness_m * up,
               .half_z = 0.5 * depth_m * out},
              1, mesh);
  }
}

void AddLouvredLeaf(const Box& leaf, Mesh& mesh) {
  Box hole = leaf;
  hole.low += Vector3d(kRim_m, kRim_m, 0.0);
  hole.high -= Vector3d(kRim_m, kRim_m, 0.0);
  AddCuboid(CuboidOf({leaf.low, {hole.low.x(), leaf.high.y(), leaf.high.z()}}), 4, mesh);
  AddCuboid(CuboidOf({{hole.high.x(), leaf.low.y(), leaf.low.z()}, leaf.high}), 4, mesh);
  AddCuboid(CuboidOf({{hole.low.x(), leaf.low.y(), leaf.low.z()},
                      {hole.high.x(), hole.low.y(), leaf.high.z()}}),
            1, mesh);
  AddCuboid(CuboidOf({{hole.low.x(), hole.high.y(), leaf.low.z()},
                      {hole.high.x(), leaf.high.y(), leaf.high.z()}}),
            1, mesh);
  AddSlats(hole, mesh);
}

}  // namespace

double ShutterReach_m(double window_width_m) {
  return kHinge_m + 0.5 * window_width_m;
}

std::array<Box, 2> ShutterLeaves(const FacadeOptions& options, const WindowPlan& window) {
  const Box& opening = window.opening;
  const double reach_m = ShutterReach_m(options.window.width_m);
  const double back_z = kLeafClearance_m;
  const double front_z = kLeafClearance_m + kThickness_m;
  return {Box{{opening.low.x() - reach_m, opening.low.y(), back_z},
              {opening.low.x() - kHinge_m, opening.high.y(), front_z}},
          Box{{opening.high.x() + kHinge_m, opening.low.y(), back_z},
              {opening.high.x() + reach_m, opening.high.y(), front_z}}};
}

Mesh MakeShutters(const FacadeOptions& options, const FacadePlan& plan, uint32_t material) {
  Mesh mesh{.name = "shutters", .material = material, .closed = true};
  for (const WindowPlan& window : plan.windows) {
    for (const Box& leaf : ShutterLeaves(options, window)) {
      const Vector3d size = leaf.high - leaf.low;
      // A small leaf has no room for slats.
      const bool louvred =
          options.shutters.louvred && std::min(size.x(), size.y()) > 2.0 * kRim_m + kSlatPitch_m;
      if (louvred) {
        AddLouvredLeaf(leaf, mesh);
      } else {
        AddCuboid(CuboidOf(leaf), 4, mesh);
      }
    }
  }
  return mesh;
}

}  // namespace fenestra
