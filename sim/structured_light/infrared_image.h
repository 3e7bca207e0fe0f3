#pragma once

#include <opencv2/core.hpp>

#include "core/random/random_stream.h"
#include "sim/structured_light/dot_pattern.h"
#include "sim/structured_light/infrared_response.h"
#include "sim/structured_light/infrared_view.h"

namespace fenestra {

/// The 10-bit image at a share of the longest exposure: at a surface of depth z a pixel in column u
/// shows the pattern at u - f b/z. A pixel that an outline or a shadow crosses gets the mean of its
/// parts' light. `surface`: the stream of this view's laser speckle; `noise`: that of this image's
/// flicker and noise.
cv::Mat1w InfraredImage(const InfraredResponse& response, const SampledPattern& pattern,
                        const InfraredRays& rays, const InfraredView& view, double exposure,
                        const RandomStream& surface, const RandomStream& noise);

}  // namespace fenestra
