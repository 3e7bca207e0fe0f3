#pragma once

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"
#include "core/random/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/camera/image_sensor.h"
#include "sim/camera/lens.h"
#include "sim/camera/point_spread.h"
#include "sim/stereo/stereo_rig_options.h"

namespace fenestra {

/// One camera of a stereo rig as it was built: what its own lens and sensor make of light. Const
/// calls are thread-safe.
class StereoCamera {
 public:
  /// Draws the camera that belongs to the stream, within the rig's tolerances. Assumes valid
  /// options.
  StereoCamera(const StereoRigOptions& options, const RandomStream& own);

  /// This camera with other figures of its sensor's noise and range.
  StereoCamera With(const ImageSensorOptions& sensor) const;

  const CameraModel& model() const { return rays_.camera(); }
  const RayGrid& rays() const { return rays_; }
  const ImageSensor& sensor() const { return sensor_; }

  /// The exposure by this camera's own options for a view from X_WC: by the mean of a coarse
  /// picture, if it is automatic.
  ExposureSetting ExposureAt(const Pose& X_WC, const RayCaster& caster, const Lighting& lighting,
                             const RandomStream& sampling) const;
  /// The exposure for an image with this mean of photo-electrons per pixel and second.
  ExposureSetting ExposureFor(double mean_electrons_per_s) const;

  /// The point spread where everything is at the distance of focus.
  PointSpread SpreadInFocus() const;
  /// 1/z of what is seen from X_WC in blocks of four by four pixels; 0 where there is nothing.
  cv::Mat1f InverseDistances(const Pose& X_WC, const RayCaster& caster) const;
  /// The point spread for a view of what is this far.
  PointSpread SpreadAt(const cv::Mat1f& inverse_distances) const;

  /// Photo-electrons per pixel and second for luminance in the image plane [cd/m²].
  cv::Mat1f ElectronsPerSecond(const QuarterImages& luminance, const PointSpread& spread) const;
  /// The image that a detector sees of photo-electrons per pixel and second.
  cv::Mat1b Image(const cv::Mat1f& electrons_per_s, const ExposureSetting& exposure,
                  const RandomStream& noise) const;

 private:
  StereoRigOptions options_;
  RandomStream stream_;
  RayGrid rays_;
  cv::Mat1f illumination_;
  RayGrid coarse_rays_;  ///< Of pixels that are four times as large.
  cv::Mat1f coarse_illumination_;
  double electrons_per_luminance_;  ///< [(e/s)/(cd/m²)] on the axis.
  Eigen::Vector2d coma_centre_;
  Focus focus_;
  double gain_;  ///< Grey values per electron, as a multiple of the design's.
  ImageSensor sensor_;
};

}  // namespace fenestra
