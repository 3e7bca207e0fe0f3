#include "scenes/facade/masonry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/facade/facade_parts.h"
#include "scenes/mesh/tessellation.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

struct Part {
  Box box;
  Solid solid;
};

// Bars of equal width that divide the frame's hole along one axis into equal parts.
void AddMullions(const Box& hole, int axis, int count, double width_m, Solid solid,
                 std::vector<Part>& parts) {
  const double clear_m = hole.high[axis] - hole.low[axis];
  for (int i = 0; i < count; ++i) {
    Part bar{hole, solid};
    const double centre = hole.low[axis] + clear_m * (i + 1) / (count + 1);
    bar.box.low[axis] = centre - 0.5 * width_m;
    bar.box.high[axis] = centre + 0.5 * width_m;
    parts.push_back(bar);
  }
}

Part SillOf(const SillOptions& sill, const WindowPlan& window) {
  const Box& opening = window.opening;
  return {{{opening.low.x() - sill.overhang_m, opening.low.y() - sill.thickness_m,
            window.frame.low.z()},
           {opening.high.x() + sill.overhang_m, opening.low.y(), sill.projection_m}},
          kSillSolid};
}

Part LintelOf(const LintelOptions& lintel, const WindowPlan& window) {
  const Box& opening = window.opening;
  return {{{opening.low.x() - lintel.overhang_m, opening.high.y(), window.frame.low.z()},
           {opening.high.x() + lintel.overhang_m, opening.high.y() + lintel.height_m,
            lintel.projection_m}},
          kLintelSolid};
}

// The boxes in the order in which they are built: later ones replace earlier ones.
std::vector<Part> PartsOf(const FacadeOptions& o, const FacadePlan& plan) {
  std::vector<Part> parts{{plan.building, kWallSolid}};
  for (const WindowPlan& window : plan.windows) {
    parts.push_back({window.room_shell, window.is_target ? kRoomSolid : kOtherRoomSolid});
  }
  for (const WindowPlan& window : plan.windows) {
    const Solid frame = window.is_target ? kFrameSolid : kOtherFrameSolid;
    parts.push_back({window.room, kAir});
    parts.push_back({window.opening, kAir});
    parts.push_back({window.frame, frame});
    parts.push_back({window.frame_hole, kAir});
    AddMullions(window.frame_hole, 0, o.window.vertical_mullions, o.window.mullion_width_m, frame,
                parts);
    AddMullions(window.frame_hole, 1, o.window.horizontal_mullions, o.window.mullion_width_m, frame,
                parts);
    if (o.sill.present) parts.push_back(SillOf(o.sill, window));
    if (o.lintel.present) parts.push_back(LintelOf(o.lintel, window));
  }
  return parts;
}

SolidLattice Build(const std::vector<Part>& parts) {
  std::array<std::vector<float>, 3> breaks;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    for (const Part& part : parts) {
      coordinates.push_back(part.box.low[axis]);
      coordinates.push_back(part.box.high[axis]);
    }
    breaks[static_cast<size_t>(axis)] = DistinctBreaks(std::move(coordinates));
  }
  SolidLattice lattice(std::move(breaks));
  for (const Part& part : parts) lattice.Fill(part.box, part.solid);
  return lattice;
}

// Light varies where something stands in its way: in an opening, on and behind its frame, and on
// the wall beside what stands before it. Cells of at most `finest_m` there, growing with the
// distance, keep the error of linear interpolation about that of the baked light itself. The wall's
// front sees nothing of an opening.
struct Detail {
  Box box;
  double finest_m;
  double growth;
  bool before_wall;
};

constexpr double kLargestCell_m = 1.0;
constexpr double kTargetCell_m = 0.05;
constexpr double kTargetGrowth = 0.5;
// Longest edge of a cell's halves over its side: of a square, and a little more for rounding.
constexpr double kDiagonal = 1.5;
// Other windows need not be as accurate as the target.
constexpr double kOtherCell_m = 0.12;
constexpr double kOtherGrowth = 1.0;
constexpr double kBeforeWallCell_m = 0.12;
constexpr double kBeforeWallGrowth = 1.0;

std::vector<Detail> DetailsOf(const FacadeOptions& o, const FacadePlan& plan) {
  std::vector<Detail> details;
  const auto add_before_wall = [&details](const Box& box) {
    details.push_back({box, kBeforeWallCell_m, kBeforeWallGrowth, true});
  };
  for (const WindowPlan& window : plan.windows) {
    // Little behind the frame can be seen from outside.
    Box box = window.opening;
    box.low.z() = window.frame.low.z();
    details.push_back({box, window.is_target ? kTargetCell_m : kOtherCell_m,
                       window.is_target ? kTargetGrowth : kOtherGrowth, false});
    if (o.sill.present && o.sill.projection_m > 0.0) add_before_wall(SillOf(o.sill, window).box);
    if (o.lintel.present && o.lintel.projection_m > 0.0) {
      add_before_wall(LintelOf(o.lintel, window).box);
    }
    if (o.shutters.present) {
      for (const Box& leaf : ShutterLeaves(o, window)) add_before_wall(leaf);
    }
  }
  if (o.drainpipe.present) {
    const double x = o.drainpipe.x_m;
    const double r = o.drainpipe.radius_m;
    const double y = 0.5 * o.wall.height_m;
    add_before_wall({{x - r, -y, 0.0}, {x + r, y, 2.0 * r}});
  }
  return details;
}

// Distances from the outline of the box's front, along the wall and along its normal.
double DistanceFrom(const Box& box, const glm::vec3& p) {
  const auto x = static_cast<double>(p.x);
  const auto y = static_cast<double>(p.y);
  const auto z = static_cast<double>(p.z);
  const double dx = std::max(box.low.x() - x, x - box.high.x());
  const double dy = std::max(box.low.y() - y, y - box.high.y());
  const double dz = std::max({box.low.z() - z, z - box.high.z(), 0.0});
  const double beside =
      dx < 0.0 && dy < 0.0 ? std::max(dx, dy) : std::hypot(std::max(dx, 0.0), std::max(dy, 0.0));
  return std::hypot(beside, dz);
}

double CellAt(const std::vector<Detail>& details, const glm::vec3& p) {
  // Sums of sizes are rounded: points within a micrometre are on the front.
  const bool on_front = p.z > -1e-6f;
  double cell_m = kLargestCell_m;
  for (const Detail& d : details) {
    const double x = static_cast<double>(p.x);
    const double reach_m = (cell_m - d.finest_m) / d.growth;
    if (x < d.box.low.x() - reach_m || x > d.box.high.x() + reach_m) continue;
    if (on_front && !d.before_wall) continue;
    cell_m = std::min(cell_m, d.finest_m + d.growth * DistanceFrom(d.box, p));
  }
  return cell_m;
}

}  // namespace

SolidSurface BuildMasonry(const FacadeOptions& options, const FacadePlan& plan) {
  // The building's other outer faces cannot be seen by a viewer of the facade's front.
  SolidSurface surface =
      Build(PartsOf(options, plan)).Surface(SolidLattice::Faces::kFrontOfLattice);
  const std::vector<Detail> details = DetailsOf(options, plan);
  BisectLongEdges(
      surface, [&details](const glm::vec3& middle) { return kDiagonal * CellAt(details, middle); });
  return surface;
}

}  // namespace fenestra
