#include "sim/structured_light/sensor_unit.h"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/io/faults.h"
#include "sim/camera/built_camera.h"
#include "sim/structured_light/disparity.h"

namespace fenestra {
namespace {

// Pixels of a camera per pixel of an image 640 px wide.
double ScaleOf(const CameraModel& camera) {
  return camera.width_px() / DisparityRange::kImageWidth;
}

CameraDeviations OfCamera(const CameraModel& design, const UnitDeviations& deviations) {
  return {.focal_length = deviations.focal_length,
          .principal_point_px = deviations.principal_point_px * ScaleOf(design),
          .distortion = deviations.color_distortion};
}

// A field with the correlation exp(-r²/4ℓ²) is white noise through a Gaussian of deviation ℓ. It is
// made on a lattice of ten pixels of 640 and interpolated.
constexpr int kLatticePixels = 10;
constexpr double kLatticeSigma = DisparityError::kWarpScale_px / kLatticePixels;
constexpr int kLatticeReach = 12;  // 4 σ.

cv::Mat1f SmoothField(const RandomStream& stream, cv::Size image) {
  const int columns = static_cast<int>(DisparityRange::kImageWidth) / kLatticePixels;
  const cv::Size lattice(columns, (columns * image.height + image.width - 1) / image.width);
  const cv::Mat1d kernel = cv::getGaussianKernel(2 * kLatticeReach + 1, kLatticeSigma, CV_64F);
  cv::Mat1f white(lattice.height + 2 * kLatticeReach, lattice.width + 2 * kLatticeReach);
  stream.FillNormals({white.ptr<float>(), white.total()});
  cv::Mat1f smooth;
  cv::sepFilter2D(white, smooth, CV_32F, kernel, kernel);
  smooth = smooth(cv::Rect({kLatticeReach, kLatticeReach}, lattice)) / kernel.dot(kernel);
  cv::Mat1f field;
  cv::resize(smooth, field, image, 0.0, 0.0, cv::INTER_CUBIC);
  return field;
}

}  // namespace

void Validate(const UnitDeviations& d) {
  Faults faults("deviations of the structured-light sensor");
  const std::array<double, 8> all = {
      d.focal_length,  d.principal_point_px, d.color_distortion,    d.rotation_rad,
      d.translation_m, d.disparity_scale,    d.disparity_offset_px, d.disparity_warp_px};
  for (const double deviation : all) {
    // Written so that NaN fails.
    if (!(deviation >= 0.0)) {
      faults.Add("standard deviations must not be negative");
      break;
    }
  }
  faults.ThrowIfAny();
}

DisparityError::DisparityError(double scale, double offset_px, double warp_px,
                               const RandomStream& warp, cv::Size image)
    : scale_(static_cast<float>(scale)), offset_px_(static_cast<float>(offset_px)) {
  if (warp_px > 0.0) warp_px_ = warp_px * SmoothField(warp, image);
}

double DisparityError::WarpDensity(double warp_px) {
  return warp_px * warp_px * 4.0 * std::numbers::pi * kWarpScale_px * kWarpScale_px;
}

SensorUnit BuildUnit(const RgbdCalibration& design, const UnitDeviations& deviations,
                     const RandomStream& unit) {
  Validate(deviations);
  SensorUnit built{.cameras = design, .disparity = {}, .deviations = deviations};
  if (deviations == UnitDeviations{}) return built;
  built.cameras.color =
      BuiltCamera(design.color, OfCamera(design.color, deviations), unit.Child("color"));
  built.cameras.depth =
      BuiltCamera(design.depth, OfCamera(design.depth, deviations), unit.Child("depth"));
  const Pose mounting =
      RandomPose(unit.Child("mounting"), deviations.rotation_rad, deviations.translation_m);
  built.cameras.X_KD = mounting * design.X_KD;
  const RandomStream disparity = unit.Child("disparity");
  built.disparity = DisparityError(deviations.disparity_scale * disparity.Normal(0),
                                   deviations.disparity_offset_px * disparity.Normal(1),
                                   deviations.disparity_warp_px, unit.Child("warp"),
                                   {design.depth.width_px(), design.depth.height_px()});
  return built;
}

Eigen::MatrixXd UnitCovariance(const RgbdCalibration& design, const UnitDeviations& deviations) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(kUnitParameters, kUnitParameters);
  covariance.topLeftCorner<9, 9>() =
      BuiltCovariance(design.color, OfCamera(design.color, deviations));
  covariance.block<6, 6>(kUnitPose, kUnitPose) =
      MovedCovariance(design.X_KD.translation(), deviations.rotation_rad, deviations.translation_m);
  // The depth camera has no distortion.
  covariance.block<4, 4>(kUnitDepthCamera, kUnitDepthCamera) =
      BuiltCovariance(design.depth, OfCamera(design.depth, deviations)).topLeftCorner<4, 4>();
  covariance(kUnitScale, kUnitScale) = std::pow(deviations.disparity_scale, 2);
  covariance(kUnitOffset, kUnitOffset) = std::pow(deviations.disparity_offset_px, 2);
  return covariance;
}

}  // namespace fenestra
