#pragma once

#include <array>
#include <optional>

#include "core/detection.h"
#include "vision/frame/frame_knowledge.h"
#include "vision/frame/frame_rectangle.h"
#include "vision/window_prior.h"

namespace fenestra {

/// What a frame may be like in space.
struct FrameLimits {
  double nearest_m = 0.4;
  double farthest_m = 15.0;
  double min_side_m = 0.3;  ///< What a drone might fly through.
  double max_side_m = 3.0;
  double max_side_ratio = 2.0;  ///< Longer over shorter side.
  /// Departure of a corner from a right angle: 15°. Of a first, rough rectangle: a side that is
  /// 40 px long is known to 5° or so.
  double max_skew_rad = 0.2617993877991494;
  double max_taper = 0.25;  ///< Relative difference of opposite sides.

  bool operator==(const FrameLimits&) const = default;
};

/// Whether four corners (in the order of WindowEstimate) are nearly those of such a rectangle.
/// Depth is not looked at.
bool AreCornersOfFrame(const std::array<Eigen::Vector3d, 4>& p_CV, const FrameLimits& limits);

/// "implausible_shape" for a fitted rectangle that is too near, too far, too small, too large or
/// too slender.
std::optional<Miss> ObjectionToFrame(const FrameRectangle& frame, const FrameLimits& limits);

/// An objection of the prior (ObjectionOf) to a rectangle that was fitted without it; sides may be
/// off by 8 % of the shorter one.
std::optional<Miss> ObjectionToPrior(const FrameRectangle& frame, const WindowPrior& prior);

/// What of a prior goes into the fit.
std::optional<SizePrior> SizePriorOf(const WindowPrior& prior);

}  // namespace fenestra
