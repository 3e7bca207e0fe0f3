#include "scenes/facade/masonry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/facade/facade_parts.h"

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

}  // namespace

SolidSurface BuildMasonry(const FacadeOptions& options, const FacadePlan& plan) {
  // The building's other outer faces cannot be seen by a viewer of the facade's front.
  return Build(PartsOf(options, plan)).Surface(SolidLattice::Faces::kFrontOfLattice);
}

}  // namespace fenestra
