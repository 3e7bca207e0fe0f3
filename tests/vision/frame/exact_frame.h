#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"

namespace fenestra::testing {

/// A frame, painted or standing back in a wall, whose pictures are exact: the area that it covers
/// of each quarter of a pixel in either direction, blurred there, gathered by pixels. Places of
/// edges are right to 1e-3 px, which sampling with rays would need a million of them a pixel for.
/// Frame O as PlanarTarget's.
struct ExactFrame {
  Pose X_LO;
  double width_m = 1.0;
  double height_m = 1.0;
  double border_m = 0.1;
  double wall_dn = 165.0;
  double frame_dn = 12.0;
  double opening_dn = 165.0;
  double blur_px = 0.45;
  double setback_m = 0.0;  ///< The wall before the frame; its opening is as large as the frame.
  double reveal_dn = 60.0;
  double black_dn = 8.0;          ///< Grey value without light.
  double vignetting_power = 4.5;  ///< Of the cosine of the angle to the optical axis.
};

/// Grey values without noise or rounding. The camera must have no distortion and the frame must be
/// wholly in its image.
cv::Mat1f ExactPicture(const CameraModel& camera, const Pose& X_CL, const ExactFrame& frame);

/// A picture's light with slopes of its own outside of each side, as a share per pixel.
cv::Mat1f WithUnevenLight(const cv::Mat1f& picture, const CameraModel& camera, const Pose& X_CL,
                          const ExactFrame& frame, const std::array<double, 4>& slopes_per_px);

/// The same with noise, the same in every pixel, rounded to 8 bits.
StereoObservation ExactPair(const StereoCalibration& rig, const ExactFrame& frame, double noise_dn,
                            const RandomStream& stream);

/// Noise for a pair that has been rendered.
StereoObservation WithNoise(const cv::Mat1f& left, const cv::Mat1f& right, double noise_dn,
                            const RandomStream& stream);

}  // namespace fenestra::testing
