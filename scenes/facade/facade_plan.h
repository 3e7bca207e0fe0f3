#pragma once

#include <vector>

#include "core/random/random_stream.h"
#include "scenes/facade/facade_options.h"
#include "scenes/mesh/solid_lattice.h"

namespace fenestra {

/// Least width of the wall around an opening, and of the masonry behind a room's surfaces.
inline constexpr double kMasonry_m = 0.1;
/// Thickness of the partition between two rooms.
inline constexpr double kPartition_m = 0.1;
/// Distance between the two panes of double glazing.
inline constexpr double kPaneGap_m = 0.016;
/// Largest share of a frame that leaves at random places cover within reasonable time.
inline constexpr double kMostPlantCoverage = 0.95;

/// The place of one window, with all boxes that make it up. z = 0 is the wall's outer face.
struct WindowPlan {
  bool is_target = false;
  int column = 0;  ///< Counted from the target's to the viewer's right.
  int row = 0;     ///< Counted from the target's upwards.
  Eigen::Vector3d p_WO = Eigen::Vector3d::Zero();  ///< Centre of the frame's front.
  Box opening;
  Box frame;
  Box frame_hole;
  Box room;
  Box room_shell;
  /// Stream of all random choices for this window.
  RandomStream random{0};
};

/// The places of everything that belongs to the building.
struct FacadePlan {
  Box building;
  std::vector<WindowPlan> windows;  ///< The target, if there is one, first.
};

/// Plans the building. The options must be valid.
FacadePlan PlanFacade(const FacadeOptions& options, const RandomStream& random);

}  // namespace fenestra
