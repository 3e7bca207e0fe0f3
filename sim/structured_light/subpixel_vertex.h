#pragma once

#include <array>

#include "sim/structured_light/sampled_pattern.h"

namespace fenestra {

/// Where, between steps of half a pixel, the correlation with the pattern is greatest.
///
/// The parabola through the logarithms of three correlations would be exact if the correlation of
/// two displaced patterns were a Gaussian. It is not: their dots are no larger than a pixel, so
/// that patterns half a pixel apart are sampled differently, and the vertex is drawn by up to 0.06
/// px towards whole pixels. The same error of the pattern with itself, known beforehand, is taken
/// off.
class SubpixelVertex {
 public:
  explicit SubpixelVertex(const SampledPattern& pattern);

  /// Offset [px] of the greatest correlation from a step at which it is `score`, by those half a
  /// pixel before and after it. Even steps are at whole pixels. Without both neighbours above 0,
  /// or if they are greater, 0.
  float Offset(bool is_whole_pixel, float before, float score, float after) const;

 private:
  /// What the parabola makes of offsets 0, kSpacing, 2 kSpacing … [px].
  static constexpr int kOffsets = 7;
  static constexpr float kSpacing = 0.05f;
  using Curve = std::array<float, kOffsets>;

  Curve at_whole_;
  Curve at_half_;
};

}  // namespace fenestra
