#pragma once

namespace fenestra {

/// Between disparity and depth: z = f b/d, for disparities in pixels of the 640-wide image in which
/// the sensor matches, and what of it the sensor delivers.
struct DisparityRange {
  /// The sensor matches in an image of this width, whatever the width of the depth image [px].
  static constexpr double kImageWidth = 640.0;

  double focal_times_baseline;  ///< f b [px m].
  double step_px;               ///< Disparities are multiples of it; 0: any.
  double nearest_m;
  double farthest_m;

  /// Ranges of the Microsoft Kinect SDK 1.8: 0.8–4.0 m, in near mode 0.4–3.0 m. focal_px: of a
  /// depth camera of this width.
  static DisparityRange Of(double focal_px, int width_px, double baseline_m, double step_px,
                           bool near_mode);

  bool Contains(double z_m) const { return z_m >= nearest_m && z_m <= farthest_m; }
  /// Depth of a disparity after quantisation [m]; 0 outside the range.
  double Depth(double disparity_px) const;
};

}  // namespace fenestra
