#pragma once

#include "core/parameter_table.h"
#include "vision/window_prior.h"

namespace fenestra {

/// What edge-stereo takes for a window, each with the reason for its default.
struct EdgeStereoOptions {
  double rectification_alpha = 1.0;  ///< As paper-stereo's.

  // Where and how large a window may be.
  double nearest_m = 0.6;    ///< Where both images of a 4 mm lens see the same 0.5 m.
  double farthest_m = 15.0;  ///< Where a 1 m frame is 44 px wide.
  double min_side_m = 0.3;   ///< What a drone might fly through.
  double max_side_m = 3.0;
  double max_side_ratio = 2.0;
  /// Of the first, rough rectangle: a side that is 40 px long is known to 5° or so.
  double max_skew_rad = 0.2617993877991494;
  double max_taper = 0.25;

  // How it may look.
  /// Three times the noise of the darkest image that a good camera delivers.
  double min_contrast_dn = 6.0;
  /// 32 of 1023, the usual pedestal of a sensor's ADC, as 8 bits show it.
  double black_dn = 8.0;
  /// Light falls off as this power of the cosine of the angle to the optical axis: 4 by nature, and
  /// a barrel takes about a tenth more towards the corners; 0 for cameras that correct it.
  double vignetting_power = 4.5;
  /// A third of the shortest side that is looked for at 10 m.
  double min_segment_px = 12.0;
  /// Textured walls have thousands; a frame's sides are among the longest and strongest.
  int most_segments = 150;
  /// Rough candidates that are measured in both views.
  int most_candidates = 8;
  int most_windows = 2;  ///< Candidates that are measured to the end.
  /// A frame that stands behind something for half of a side is still one.
  double min_side_support = 0.4;
  /// See darkness.h: of bright and dark at 1.4 : 1; brick and its joints have less.
  double min_darkness = 0.25;

  // The border between wall and opening.
  double min_border_m = 0.02;
  double max_border_share = 0.3;  ///< Of the shorter side.

  /// A known size also goes into the fit, and helps the depth.
  WindowPrior prior;

  bool operator==(const EdgeStereoOptions&) const = default;
};

/// Throws InputError with all faults.
void Validate(const EdgeStereoOptions& options);

const ParameterTable<EdgeStereoOptions>& EdgeStereoParameters();

}  // namespace fenestra
