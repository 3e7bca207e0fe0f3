#pragma once

#include "vision/frame/side_request.h"
#include "vision/window_prior.h"

namespace fenestra {

/// The width that every frame has at least: 6 % of the shorter side. Where no inner edge was found.
double GuessedBorder(const FrameRectangle& frame);

/// Of the median grey values in the middle of a frame's four sides, the greatest over the least,
/// each at least `black_dn`, without sides that stand before the frame's front. 1 for a frame of
/// one paint in even light.
double BrightestOverDarkestSide(const CameraView& view, const FrameRectangle& frame,
                                double black_dn);

/// Share of places in the middle of a frame's border that have the expected colour.
double ShareOfColor(const CameraView& view, const FrameRectangle& frame, const WindowPrior& prior,
                    const cv::Mat3b& color);

}  // namespace fenestra
