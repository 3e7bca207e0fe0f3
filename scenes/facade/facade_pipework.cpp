#include "scenes/facade/facade_pipework.h"

#include <algorithm>
#include <cmath>

#include "scenes/mesh/solid_bodies.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

constexpr int kPipeSides = 16;
constexpr int kThinSides = 6;
constexpr double kPipeSlice_m = 0.25;
constexpr double kCableSlice_m = 0.4;
constexpr double kRailingBeyond_m = 0.10;   // Wider than the opening, on both sides.
constexpr double kHandRailThickness = 1.5;  // In bar radii.
constexpr double kRailSlice_m = 0.2;
constexpr double kLowerRail_m = 0.04;  // Above the opening's lower edge.

Mesh EmptyBars(const char* name, uint32_t material) {
  return {.name = name, .material = material, .closed = true};
}

int SliceCount(double length_m, double slice_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / slice_m)));
}

std::vector<Vector3d> StraightPath(const Vector3d& from_W, const Vector3d& to_W, double slice_m) {
  const int slices = SliceCount((to_W - from_W).norm(), slice_m);
  std::vector<Vector3d> path;
  for (int i = 0; i <= slices; ++i) {
    path.emplace_back(from_W + static_cast<double>(i) / slices * (to_W - from_W));
  }
  return path;
}

}  // namespace

Mesh MakeDrainpipe(const FacadeOptions& options, uint32_t material) {
  const DrainpipeOptions& pipe = options.drainpipe;
  Mesh mesh = EmptyBars("drainpipe", material);
  const double y = 0.5 * options.wall.height_m;
  const double z = pipe.clearance_m + pipe.radius_m;
  AddBar(StraightPath({pipe.x_m, -y, z}, {pipe.x_m, y, z}, kPipeSlice_m), pipe.radius_m, kPipeSides,
         mesh);
  return mesh;
}

Mesh MakeCables(const FacadeOptions& options, const RandomStream& random, uint32_t material) {
  const CableOptions& cables = options.cables;
  Mesh mesh = EmptyBars("cables", material);
  const double width_m = options.wall.width_m;
  const int slices = SliceCount(width_m, kCableSlice_m);
  for (int cable = 0; cable < cables.count; ++cable) {
    const double u = random.Child("sag", static_cast<uint64_t>(cable)).Uniform(0);
    const double sag_m = cables.sag_m * (0.7 + 0.6 * u);
    const double lowest_y = cables.height_m + cable * (cables.spacing_m + 2.0 * cables.radius_m);
    std::vector<Vector3d> path;
    for (int i = 0; i <= slices; ++i) {
      const double s = static_cast<double>(i) / slices - 0.5;
      path.emplace_back(s * width_m, lowest_y + 4.0 * sag_m * s * s, cables.distance_m);
    }
    AddBar(path, cables.radius_m, kThinSides, mesh);
  }
  return mesh;
}

Mesh MakeRailing(const FacadeOptions& options, const WindowPlan& window, uint32_t material) {
  const RailingOptions& railing = options.railing;
  Mesh mesh = EmptyBars("railing", material);
  const double rail_radius_m = kHandRailThickness * railing.bar_radius_m;
  const double left_x = window.opening.low.x() - kRailingBeyond_m;
  const double right_x = window.opening.high.x() + kRailingBeyond_m;
  const double z = railing.distance_m;
  const double hand_y = window.opening.low.y() + railing.height_m;
  const double lower_y = window.opening.low.y() + std::min(kLowerRail_m, 0.5 * railing.height_m);
  for (const double y : {lower_y, hand_y}) {
    AddBar(StraightPath({left_x, y, z}, {right_x, y, z}, kRailSlice_m), rail_radius_m, kThinSides,
           mesh);
  }
  const int gaps = SliceCount(right_x - left_x, railing.bar_spacing_m);
  for (int i = 0; i <= gaps; ++i) {
    const double x = left_x + (right_x - left_x) * i / gaps;
    // The bars end within the rails.
    AddBar({{x, lower_y, z}, {x, hand_y, z}}, railing.bar_radius_m, kThinSides, mesh);
  }
  return mesh;
}

}  // namespace fenestra
