#pragma once

#include "vision/frame/side_request.h"

namespace fenestra {

/// Looks for the edge along a side of the frame, near to where the frame as it is assumed would
/// have it. The side is cut into strips (edge_strips.h), in each of which a step is fitted to all
/// its pixels (step_fit.h). A pixel's weight is the inverse of its variance, which goes from the
/// dark side's to the bright one's with P. s0's variance is that of the fit, scaled by the
/// residuals: by their median over the side's strips, since one has few pixels, or by the strip's
/// own where these are more than twice as large. Strips without such an edge are left out.
///
/// Why the far pixels: in a few, a slope of the light beside the edge looks much like a shift of
/// it.
SideEdges MeasureSide(const CameraView& view, const FrameRectangle& frame,
                      const SideRequest& request, const EdgeTuning& tuning);

}  // namespace fenestra
