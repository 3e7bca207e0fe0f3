#pragma once

#include <array>
#include <optional>

#include "core/detection.h"
#include "vision/frame/frame_adjustment.h"
#include "vision/frame/frame_rectangle.h"
#include "vision/window_prior.h"

namespace fenestra {

/// What a frame may be like in space.
struct FrameLimits {
  double nearest_m;
  double farthest_m;
  double min_side_m;
  double max_side_m;
  double max_side_ratio;  ///< Longer over shorter side.
  double max_skew_rad;    ///< Departure of a corner from a right angle.
  double max_taper;       ///< Relative difference of opposite sides.
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
