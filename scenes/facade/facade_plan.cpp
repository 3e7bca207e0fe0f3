#include "scenes/facade/facade_plan.h"

#include <algorithm>

namespace fenestra {
namespace {

using Eigen::Vector3d;

// A room: a sill at the usual 0.9 m above the floor, a lintel, and space to both sides, as far as
// the wall is large enough and no other room is in the way.
constexpr double kSill_m = 0.9;
constexpr double kLintel_m = 0.6;
constexpr double kBeside_m = 1.5;

Box RoomOf(const FacadeOptions& o, const Vector3d& p_WO) {
  const GridOptions& g = o.grid;
  const double x = 0.5 * o.window.width_m;
  const double y = 0.5 * o.window.height_m;
  double beside = kBeside_m;
  double below = kSill_m;
  double above = kLintel_m;
  if (g.windows_left + g.windows_right > 0) {
    beside = std::min(beside, 0.5 * (g.gap_x_m - kPartition_m));
  }
  if (g.windows_above + g.windows_below > 0) {
    const double shrink = std::min(1.0, (g.gap_y_m - kPartition_m) / (kSill_m + kLintel_m));
    below *= shrink;
    above *= shrink;
  }
  const double end_x = 0.5 * o.wall.width_m - kMasonry_m;
  const double end_y = 0.5 * o.wall.height_m - kMasonry_m;
  const double front_z = -o.wall.thickness_m;
  return {{std::max(p_WO.x() - x - beside, -end_x), std::max(p_WO.y() - y - below, -end_y),
           front_z - o.room.depth_m},
          {std::min(p_WO.x() + x + beside, end_x), std::min(p_WO.y() + y + above, end_y), front_z}};
}

WindowPlan PlanWindow(const FacadeOptions& o, int column, int row, const RandomStream& random) {
  const WindowOptions& w = o.window;
  // One index per place, wherever the grid ends.
  constexpr uint64_t kRows = uint64_t{1} << 32;
  const uint64_t index = kRows * static_cast<uint32_t>(column) + static_cast<uint32_t>(row);
  WindowPlan plan{.is_target = column == 0 && row == 0,
                  .column = column,
                  .row = row,
                  .p_WO = {column * (w.width_m + o.grid.gap_x_m),
                           row * (w.height_m + o.grid.gap_y_m), -w.setback_m},
                  .opening = {},
                  .frame = {},
                  .frame_hole = {},
                  .room = {},
                  .room_shell = {},
                  .random = random.Child("window", index)};
  const Vector3d half(0.5 * w.width_m, 0.5 * w.height_m, 0.0);
  const Vector3d bar(w.frame_width_m, w.frame_width_m, 0.0);
  const auto at_depth = [&](const Vector3d& corner, double z) {
    return Vector3d(plan.p_WO.x() + corner.x(), plan.p_WO.y() + corner.y(), z);
  };
  plan.opening = {at_depth(-half, -o.wall.thickness_m), at_depth(half, 0.0)};
  plan.frame = {at_depth(-half, -w.setback_m - w.frame_depth_m), at_depth(half, -w.setback_m)};
  plan.frame_hole = {plan.frame.low + bar, plan.frame.high - bar};
  plan.room = RoomOf(o, plan.p_WO);
  // Two shells make one partition.
  const Vector3d shell = Vector3d::Constant(0.5 * kPartition_m);
  plan.room_shell = {plan.room.low - shell, plan.room.high + shell};
  plan.room_shell.high.z() = plan.room.high.z();
  return plan;
}

}  // namespace

FacadePlan PlanFacade(const FacadeOptions& options, const RandomStream& random) {
  const GridOptions& g = options.grid;
  FacadePlan plan;
  const double x = 0.5 * options.wall.width_m;
  const double y = 0.5 * options.wall.height_m;
  const double back_z = -options.wall.thickness_m - options.room.depth_m - kMasonry_m;
  plan.building = {{-x, -y, back_z}, {x, y, 0.0}};
  if (options.with_target) plan.windows.push_back(PlanWindow(options, 0, 0, random));
  for (int row = -g.windows_below; row <= g.windows_above; ++row) {
    for (int column = -g.windows_left; column <= g.windows_right; ++column) {
      if (column == 0 && row == 0) continue;
      WindowPlan window = PlanWindow(options, column, row, random);
      if (window.random.Child("present").Uniform(0) < options.grid.other_windows_share) {
        plan.windows.push_back(window);
      }
    }
  }
  return plan;
}

}  // namespace fenestra
