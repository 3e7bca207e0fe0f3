#pragma once

#include <vector>

#include "core/random/random_stream.h"
#include "scenes/facade/facade_options.h"
#include "scenes/mesh/solid_lattice.h"

namespace fenestra {

/// Around an opening is at least this much wall, and behind a room's surfaces this much masonry.
inline constexpr double kMasonry_m = 0.1;
/// Between two rooms.
inline constexpr double kPartition_m = 0.1;
/// Between the two panes of double glazing.
inline constexpr double kPaneGap_m = 0.016;
/// More than this of a frame cannot be covered by leaves that hang at random places in time.
inline constexpr double kMostPlantCoverage = 0.95;

/// Where one window stands, with all boxes that make it. z = 0 is the wall's outer face.
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
  /// For all that is random about this window.
  RandomStream random{0};
};

/// Where everything that belongs to the building stands.
struct FacadePlan {
  Box building;
  std::vector<WindowPlan> windows;  ///< The target, if there is one, first.
};

/// The options must be valid.
FacadePlan PlanFacade(const FacadeOptions& options, const RandomStream& random);

}  // namespace fenestra
