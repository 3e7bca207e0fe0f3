#pragma once

#include <array>
#include <optional>

#include "core/detection/detection.h"
#include "core/detection/window_prior.h"
#include "vision/frame/model/frame_prior.h"
#include "vision/frame/model/frame_rectangle.h"

namespace fenestra {

/// Limits on the size, shape and distance of a window frame.
struct FrameLimits {
  double nearest_m = 0.4;
  double farthest_m = 15.0;
  double min_side_m = 0.3;  ///< The smallest opening a drone might fly through.
  double max_side_m = 3.0;
  double max_side_ratio = 2.0;  ///< Longer side over shorter side.
  /// Largest departure of a corner from a right angle, 15°. It applies to a first, rough rectangle:
  /// the direction of a side that is 40 px long is known to about 5°.
  double max_skew_rad = 0.2617993877991494;
  double max_taper = 0.25;  ///< Relative difference of opposite sides.

  bool operator==(const FrameLimits&) const = default;
};

/// Tells whether four corners (in the order of WindowEstimate) nearly form a rectangle within the
/// limits. Depth is not checked.
bool AreCornersOfFrame(const std::array<Eigen::Vector3d, 4>& p_CV, const FrameLimits& limits);

/// Returns "implausible_shape" for a fitted rectangle that is too near, too far, too small, too
/// large or too slender.
std::optional<Miss> ObjectionToFrame(const FrameRectangle& frame, const FrameLimits& limits);

/// Returns the prior's objection (see ObjectionOf) to a rectangle that was fitted without it. Sides
/// may differ from the prior by 8 % of the shorter side.
std::optional<Miss> ObjectionToPrior(const FrameRectangle& frame, const WindowPrior& prior);

/// The part of a prior that enters the fit as an observation.
std::optional<SizePrior> SizePriorOf(const WindowPrior& prior);

}  // namespace fenestra
