#pragma once

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

/// "implausible_shape" for a fitted rectangle that is too near, too far, too small, too large or
/// too slender.
std::optional<Miss> ObjectionToFrame(const FrameRectangle& frame, const FrameLimits& limits);

/// "unexpected_size" for a rectangle, fitted without knowing what is expected, whose sides are off
/// by more than 8 % of the shorter expected side and five standard deviations: another window.
std::optional<Miss> ObjectionToSize(const FrameRectangle& frame,
                                    const std::optional<SizePrior>& expected);

/// An objection of the prior (ObjectionOf) to a rectangle that was fitted without it; sides may be
/// off by 8 % of the shorter one.
std::optional<Miss> ObjectionToPrior(const FrameRectangle& frame, const WindowPrior& prior);

/// What of a prior goes into the fit.
std::optional<SizePrior> SizePriorOf(const WindowPrior& prior);

}  // namespace fenestra
