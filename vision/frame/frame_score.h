#pragma once

#include <span>

#include "vision/frame/darkness.h"
#include "vision/frame/frame_fit.h"

namespace fenestra {

/// DarkInside of the frame's outer sides, piece by piece, as the lens bends them; mean of the
/// views.
double FrameClarity(std::span<const CameraView> views, const FrameRectangle& frame,
                    const DarknessSettings& settings);

/// The frame's grey value over its wall's, DarkOverBright along the outer sides; mean of the views.
double FrameGreyRatio(std::span<const CameraView> views, const FrameRectangle& frame,
                      const DarknessSettings& settings);

/// How much speaks for a fitted frame, 0 to 1: its clarity and how much of its sides was found;
/// less if its sides are not in one plane or if a bright band lies around it (BrightBand).
double FrameScore(std::span<const CameraView> views, const FrameFit& fit,
                  const DarknessSettings& settings);

}  // namespace fenestra
