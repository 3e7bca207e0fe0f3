#include "scenes/facade/facade_blind.h"

#include <algorithm>
#include <cmath>

#include "scenes/mesh/solid_bodies.h"

namespace fenestra {
namespace {

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

}  // namespace

void AddBlind(const FacadeOptions& options, const WindowPlan& window, double coverage, Mesh& mesh) {
  if (!(coverage > 0.0)) return;
  const Hanging hanging = Hang(options.blind, window, coverage);
  if (options.blind.slatted) {
    AddSlats(options.blind, hanging, mesh);
  } else {
    AddSheet(hanging, mesh);
  }
}

}  // namespace fenestra
