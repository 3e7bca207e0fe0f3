#pragma once

#include <array>

#include "sim/structured_light/dot_pattern.h"

namespace fenestra {

/// The program that turns disparities into depths.
enum class DepthDriver {
  kMicrosoft,  ///< Kinect SDK 1.8: 0.8–4.0 m, in near mode 0.4–3.0 m; 1/16 px, by the levels of its
               ///< depth table.
  kOpenNi,  ///< Steps of 1/8 px (ROS kinect_calibration/technical); 0.5 to 9 m, as recordings
            ///< have them (PCL, TUM RGB-D).
};

/// Conversion of disparity to depth, z = f b/d, for disparities in pixels of the 640-wide image in
/// which the sensor matches, with the steps and the range that the sensor delivers.
struct DisparityRange {
  /// The sensor matches in an image of this width, whatever the width of the depth image [px].
  static constexpr double kImageWidth = 640.0;

  double focal_times_baseline;  ///< f b [px m].
  double step_px;               ///< Disparities are multiples of it; 0: any.
  double nearest_m;
  double farthest_m;

  /// What a driver delivers. focal_px: of a depth camera of this width; near_mode: Microsoft's.
  static DisparityRange Of(double focal_px, int width_px, double baseline_m, DepthDriver driver,
                           bool near_mode);

  bool Contains(double z_m) const { return z_m >= nearest_m && z_m <= farthest_m; }
  /// Depth of a disparity after quantisation [m]; 0 outside the range.
  double Depth(double disparity_px) const;
};

/// Position of the greatest correlation with the pattern between steps of half a pixel.
///
/// The parabola through the logarithms of three correlations would be exact if the correlation of
/// two displaced patterns were a Gaussian. It is not: their dots are no larger than a pixel, so
/// that patterns half a pixel apart are sampled differently, and the vertex is drawn by up to 0.06
/// px towards whole pixels. The error of the pattern matched with itself is known beforehand
/// and subtracted.
class SubpixelVertex {
 public:
  explicit SubpixelVertex(const SampledPattern& pattern);

  /// Offset [px] of the greatest correlation from a step with the correlation `score`, by those
  /// half a pixel before and after it. Even steps are at whole pixels. 0 unless both neighbours are
  /// above 0 and not greater than the score.
  float Offset(bool is_whole_pixel, float before, float score, float after) const;

 private:
  /// Offsets that the parabola finds for true offsets of 0, kSpacing, 2 kSpacing … [px].
  static constexpr int kOffsets = 7;
  static constexpr float kSpacing = 0.05f;
  using Curve = std::array<float, kOffsets>;

  Curve at_whole_;
  Curve at_half_;
};

}  // namespace fenestra
