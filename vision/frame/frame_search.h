#pragma once

#include <string>
#include <vector>

#include "core/io/parameter_table.h"
#include "vision/frame/model/frame_limits.h"

namespace fenestra {

/// Options common to the detectors that find a frame by its edges, each with the reason for its
/// default. The defaults without a reason depend on the sensor.
struct FrameSearchOptions {
  FrameLimits limits;

  /// Three times the noise of the darkest usable image of a good camera.
  double min_contrast_dn = 6.0;
  /// Light falls off as this power of the cosine of the angle to the optical axis. Natural
  /// vignetting has 4, and a lens barrel takes about a tenth more towards the corners; 0 is for
  /// cameras that correct it.
  double vignetting_power = 4.5;
  double min_segment_px = 12.0;
  /// Textured walls have thousands of edges, but a frame's sides are among the longest and
  /// strongest.
  int most_segments = 150;
  int most_candidates = 8;  ///< Rough candidates that are fitted roughly.
  int most_windows = 2;     ///< Candidates that are fitted completely.
  /// A frame is still accepted if something hides half of a side.
  double min_side_support = 0.4;
  /// See darkness.h. This is the value for bright and dark at 1.4 : 1; brick and its joints have
  /// less.
  double min_darkness = 0.25;

  // The border between wall and opening.
  double min_border_m = 0.02;
  double max_border_share = 0.3;  ///< Share of the shorter side.

  bool operator==(const FrameSearchOptions&) const = default;
};

/// Parameters of these options, to be adopted by a detector's table.
const ParameterTable<FrameSearchOptions>& FrameSearchParameters();

/// Contradictions between options. Ranges are checked by the parameter table.
std::vector<std::string> FaultsOf(const FrameSearchOptions& options);

}  // namespace fenestra
