#pragma once

#include "core/detection/window_prior.h"
#include "vision/frame/measurement/side_request.h"

namespace fenestra {

/// Border width that is assumed where no inner edge was found: 6 % of the shorter side, the least
/// that frames have.
double GuessedBorder(const FrameRectangle& frame);

/// Ratio of the greatest to the least of the median grey values in the middle of a frame's four
/// sides, each taken as at least `black_dn`. Sides seen in front of the frame's front are left out.
/// It is 1 for a frame of one paint in even light.
double BrightestOverDarkestSide(const CameraView& view, const FrameRectangle& frame,
                                double black_dn);

/// Share of the places in the middle of a frame's border that have the expected colour.
double ShareOfColor(const CameraView& view, const FrameRectangle& frame, const WindowPrior& prior,
                    const cv::Mat3b& color);

}  // namespace fenestra
