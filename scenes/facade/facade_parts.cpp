#include "scenes/facade/facade_parts.h"

#include <algorithm>
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

using Eigen::Vector3d;

constexpr double kBlindBeside_m = 0.005;    // Between reveal and blind.
constexpr double kBlindClearance_m = 0.01;  // Between frame and blind.
constexpr double kSheet_m = 0.004;
constexpr double kBlindSlatThickness_m = 0.002;
// A slat is this much deeper than the pitch: at a tilt of 60 degrees slats just overlap.
constexpr double kSlatOverlap = 1.2;
constexpr double kSheetSlice_m = 0.1;

struct Hanging {
  double left_x;
  double right_x;
  double bottom_y;
  double top_y;
  double centre_z;

  double width_m() const { return right_x - left_x; }
  double height_m() const { return top_y - bottom_y; }
};

double DepthOf(const BlindOptions& blind) {
  if (!blind.slatted) return kSheet_m;
  return kSlatOverlap * blind.slat_pitch_m * std::cos(blind.slat_tilt_rad) +
         kBlindSlatThickness_m * std::sin(blind.slat_tilt_rad);
}

Hanging Hang(const BlindOptions& blind, const WindowPlan& window, double coverage) {
  const Box& opening = window.opening;
  const Box& seen = blind.outside ? window.frame : window.frame_hole;
  const double away_m = kBlindClearance_m + 0.5 * DepthOf(blind);
  return {
      .left_x = opening.low.x() + kBlindBeside_m,
      .right_x = opening.high.x() - kBlindBeside_m,
      .bottom_y = seen.high.y() - coverage * (seen.high.y() - seen.low.y()),
      .top_y = opening.high.y(),
      .centre_z = blind.outside ? window.frame.high.z() + away_m : window.frame.low.z() - away_m};
}

void AddSheet(const Hanging& h, Mesh& mesh) {
  const int slices = std::max(1, static_cast<int>(std::ceil(h.height_m() / kSheetSlice_m)));
  AddCuboid(CuboidOf({{h.left_x, h.bottom_y, h.centre_z - 0.5 * kSheet_m},
                      {h.right_x, h.top_y, h.centre_z + 0.5 * kSheet_m}}),
            slices, mesh);
}

// Slats from the top down at the nominal pitch; the last one ends where the blind ends.
void AddSlats(const BlindOptions& blind, const Hanging& h, Mesh& mesh) {
  const double depth_m = kSlatOverlap * blind.slat_pitch_m;
  const double tilt = blind.slat_tilt_rad;
  const Vector3d along(0.5 * h.width_m(), 0.0, 0.0);
  // Outwards and down, as they keep out the sun.
  const Vector3d out(0.0, -std::sin(tilt), std::cos(tilt));
  const Vector3d up(0.0, std::cos(tilt), std::sin(tilt));
  const double reach_m = 0.5 * (depth_m * std::sin(tilt) +
                                kBlindSlatThickness_m * std::cos(tilt));  // Above the centre.
  const double room_m = h.height_m() - 2.0 * reach_m;
  if (room_m < 0.0) return;  // Too little is let down for a slat.
  const int gaps = static_cast<int>(std::ceil(room_m / blind.slat_pitch_m));
  for (int i = 0; i <= gaps; ++i) {
    const double share = gaps > 0 ? static_cast<double>(i) / gaps : 0.0;
    AddCuboid(
        {.centre_W = {0.5 * (h.left_x + h.right_x), h.top_y - reach_m - share * room_m, h.centre_z},
         .half_x = along,
         .half_y = 0.5 * kBlindSlatThickness_m * up,
         .half_z = 0.5 * depth_m * out},
        1, mesh);
  }
}

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

constexpr double kRebate_m = 0.005;

void AddPane(const Box& hole, double z, Mesh& mesh) {
  const auto base = static_cast<uint32_t>(mesh.positions_W.size());
  const auto left = static_cast<float>(hole.low.x() - kRebate_m);
  const auto right = static_cast<float>(hole.high.x() + kRebate_m);
  const auto bottom = static_cast<float>(hole.low.y() - kRebate_m);
  const auto top = static_cast<float>(hole.high.y() + kRebate_m);
  const auto depth = static_cast<float>(z);
  mesh.positions_W.insert(
      mesh.positions_W.end(),
      {{left, bottom, depth}, {right, bottom, depth}, {right, top, depth}, {left, top, depth}});
  mesh.triangles.emplace_back(base, base + 1, base + 2);
  mesh.triangles.emplace_back(base, base + 2, base + 3);
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

void AddBlind(const FacadeOptions& options, const WindowPlan& window, double coverage, Mesh& mesh) {
  if (!(coverage > 0.0)) return;
  const Hanging hanging = Hang(options.blind, window, coverage);
  if (options.blind.slatted) {
    AddSlats(options.blind, hanging, mesh);
  } else {
    AddSheet(hanging, mesh);
  }
}

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

void AddPanes(const WindowOptions& options, const WindowPlan& window, Mesh& mesh) {
  const double middle_z = -options.setback_m - 0.5 * options.frame_depth_m;
  if (options.double_glazing) {
    AddPane(window.frame_hole, middle_z + 0.5 * kPaneGap_m, mesh);
    AddPane(window.frame_hole, middle_z - 0.5 * kPaneGap_m, mesh);
  } else {
    AddPane(window.frame_hole, middle_z, mesh);
  }
}

}  // namespace fenestra
