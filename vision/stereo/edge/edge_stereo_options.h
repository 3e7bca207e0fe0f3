#pragma once

#include "core/detection/window_prior.h"
#include "core/io/parameter_table.h"
#include "vision/frame/frame_search.h"

namespace fenestra {

/// Options of edge-stereo, each with the reason for its default.
struct EdgeStereoOptions {
  double rectification_alpha = 1.0;  ///< See PaperStereoOptions.

  FrameSearchOptions search{
      .limits = {.nearest_m = 0.6,     // Where both images of a 4 mm lens see the same 0.5 m.
                 .farthest_m = 15.0},  // Where a 1 m frame is 44 px wide.
      .min_segment_px = 12.0};         // A third of the shortest side that is looked for at 10 m.
  /// Grey value without light: 32 of 1023, the usual pedestal of a sensor's ADC, in 8 bits.
  double black_dn = 8.0;

  /// A known size also enters the fit and improves the depth.
  WindowPrior prior;

  bool operator==(const EdgeStereoOptions&) const = default;
};

/// Throws InputError with all faults.
void Validate(const EdgeStereoOptions& options);

const ParameterTable<EdgeStereoOptions>& EdgeStereoParameters();

}  // namespace fenestra
