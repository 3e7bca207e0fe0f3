#pragma once

#include <string>
#include <vector>

#include "core/parameter_table.h"
#include "vision/frame/frame_limits.h"

namespace fenestra {

/// What detectors that look for a frame by its edges take for one, each with the reason for its
/// default; those without depend on the sensor.
struct FrameSearchOptions {
  FrameLimits limits;

  /// Three times the noise of the darkest image that a good camera delivers.
  double min_contrast_dn = 6.0;
  /// Light falls off as this power of the cosine of the angle to the optical axis: 4 by nature, and
  /// a barrel takes about a tenth more towards the corners; 0 for cameras that correct it.
  double vignetting_power = 4.5;
  double min_segment_px = 12.0;
  /// Textured walls have thousands; a frame's sides are among the longest and strongest.
  int most_segments = 150;
  int most_candidates = 8;  ///< Rough candidates that are measured.
  int most_windows = 2;     ///< Candidates that are measured to the end.
  /// A frame that stands behind something for half of a side is still one.
  double min_side_support = 0.4;
  /// See darkness.h: of bright and dark at 1.4 : 1; brick and its joints have less.
  double min_darkness = 0.25;

  // The border between wall and opening.
  double min_border_m = 0.02;
  double max_border_share = 0.3;  ///< Of the shorter side.

  bool operator==(const FrameSearchOptions&) const = default;
};

/// To be adopted by the table of a detector.
const ParameterTable<FrameSearchOptions>& FrameSearchParameters();

/// What is contradictory. Ranges are the parameters' own matter.
std::vector<std::string> FaultsOf(const FrameSearchOptions& options);

}  // namespace fenestra
