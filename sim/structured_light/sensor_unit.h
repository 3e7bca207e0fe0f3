#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"

namespace fenestra {

/// How a sensor as built differs from what is known of it: standard deviations of independent
/// normal laws. Pixels and disparities are those of an image 640 px wide.
struct UnitDeviations {
  double focal_length = 0.0;        ///< Relative, of each camera, the same for both axes.
  double principal_point_px = 0.0;  ///< Of each camera and axis.
  double color_distortion = 0.0;    ///< Of each coefficient of the colour lens, relative.
  double rotation_rad = 0.0;        ///< Of the colour camera about each axis.
  double translation_m = 0.0;       ///< Of the colour camera along each axis.
  double disparity_scale = 0.0;     ///< Relative.
  double disparity_offset_px = 0.0;
  double disparity_warp_px = 0.0;  ///< RMS; see DisparityError.

  /// What a calibration of this one unit leaves. Pictures of a board give both cameras and the pose
  /// between them as well as board sessions with cameras of 640 px do, and offset and scale are
  /// found by distances of the same boards: 0.05 px are 5 mm at 2 m, after warming up, and within
  /// ± 3 mm at 1.5 m, to which a correction brings a Kinect (S. Clarkson et al., "Distortion
  /// correction of depth data from consumer depth cameras", 2013). The warp is that of recordings,
  /// since few correct it.
  static UnitDeviations Calibrated() {
    return {.focal_length = 1e-3,
            .principal_point_px = 1.0,
            .color_distortion = 0.02,
            .rotation_rad = 1e-3,
            .translation_m = 1e-3,
            .disparity_scale = 2e-3,
            .disparity_offset_px = 0.05,
            .disparity_warp_px = kRecordedWarp_px};
  }
  /// What the constants of a driver leave, which are the same for all units. Colour cameras of
  /// three Kinects: f = 517, 521 and 535 px of the 531 that the SDK states, principal points up to
  /// 16 px from the middle (TUM RGB-D benchmark). Their depths had to be scaled by up to 4 %, which
  /// its steps of depth still show. Colour camera to depth camera: turned by 18 mrad, 11 mm off the
  /// plane (N. Burrus' Kinect). Offset: depths at 1.1 m drift by 1 cm in the first hour (J. Chow et
  /// al., "Performance analysis of a low-cost triangulation-based 3D camera", 2012), 0.35 px.
  static UnitDeviations Factory() {
    return {.focal_length = 0.02,
            .principal_point_px = 8.0,
            .color_distortion = 0.1,
            .rotation_rad = 0.01,
            .translation_m = 5e-3,
            .disparity_scale = 0.02,
            .disparity_offset_px = 0.35,
            .disparity_warp_px = kRecordedWarp_px};
  }

  bool operator==(const UnitDeviations&) const = default;

 private:
  // Fitted, with DisparityError's scale, to what five recorded planes hold besides a plane and
  // noise: 0.05 to 0.12 px (PCL; TUM RGB-D). RecordingsTest holds it there.
  static constexpr double kRecordedWarp_px = 0.12;
};

/// Throws InputError with all faults.
void Validate(const UnitDeviations& deviations);

/// The error of a unit's disparity d at a pixel, s d + c + w(pixel) [px of a 640-wide image]: scale
/// and offset, and a smooth random field w that lenses and the memorised pattern leave, with the
/// correlation exp(-r²/4ℓ²) of pixels r apart. Recorded planes have such a field, whose size hardly
/// depends on the part of the image that is looked at: it does not come from the lenses' radial
/// distortion alone.
class DisparityError {
 public:
  static constexpr double kWarpScale_px = 30.0;  ///< ℓ; fitted to recordings.

  /// No error.
  DisparityError() = default;
  /// w of this RMS, drawn for depth images of this size.
  DisparityError(double scale, double offset_px, double warp_px, const RandomStream& warp,
                 cv::Size image);

  /// The disparity that the unit finds where it should find this one.
  float Of(float disparity_px, cv::Point pixel) const {
    const float found_px = disparity_px + scale_ * disparity_px + offset_px_;
    return warp_px_.empty() ? found_px : found_px + warp_px_(pixel);
  }

  /// ∫ of w's covariance over the image, its spectral density at frequency 0 [px² of disparity
  /// times px² of area].
  static double WarpDensity(double warp_px);

 private:
  float scale_ = 0.0f;
  float offset_px_ = 0.0f;
  cv::Mat1f warp_px_;  ///< w; empty: none.
};

/// A sensor as built.
struct SensorUnit {
  /// As they truly are. The depth camera is the infra-red camera, whatever the depth image's pixels
  /// are.
  RgbdCalibration cameras;
  DisparityError disparity;
  UnitDeviations deviations;  ///< From which these were drawn.
};

/// A unit of this design, whose depth camera has no distortion.
SensorUnit BuildUnit(const RgbdCalibration& design, const UnitDeviations& deviations,
                     const RandomStream& unit);

/// Parameters in which units differ, in this order: of the colour camera, fx, fy, cx, cy [px], k1,
/// k2, p1, p2, k3; of X_KD, a local rotation vector, R = exp(δ) R₀ [rad], and the translation [m];
/// of the depth camera, fx, fy, cx, cy [px]; scale and offset of DisparityError.
inline constexpr int kUnitPose = 9;
inline constexpr int kUnitDepthCamera = kUnitPose + 6;
inline constexpr int kUnitScale = kUnitDepthCamera + 4;
inline constexpr int kUnitOffset = kUnitScale + 1;
inline constexpr int kUnitParameters = kUnitOffset + 1;

/// Covariance of the parameters of units of this design.
Eigen::MatrixXd UnitCovariance(const RgbdCalibration& design, const UnitDeviations& deviations);

}  // namespace fenestra
