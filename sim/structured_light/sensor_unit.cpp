#include "sim/structured_light/sensor_unit.h"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/io/faults.h"
#include "sim/structured_light/disparity.h"

namespace fenestra {
namespace {

// Pixels of a camera per pixel of an image 640 px wide.
double ScaleOf(const CameraModel& camera) {
  return camera.width_px() / DisparityRange::kImageWidth;
}

CameraModel Built(const CameraModel& design, const UnitDeviations& deviations,
                  const RandomStream& camera) {
  CameraParameters built = design.parameters();
  const double focal = 1.0 + deviations.focal_length * camera.Child("focal_length").Normal(0);
  built.fx_px *= focal;
  built.fy_px *= focal;
  const double shift_px = deviations.principal_point_px * ScaleOf(design);
  const RandomStream principal_point = camera.Child("principal_point");
  built.cx_px += shift_px * principal_point.Normal(0);
  built.cy_px += shift_px * principal_point.Normal(1);
  const RandomStream distortion = camera.Child("distortion");
  BrownConrady& d = built.distortion;
  uint64_t index = 0;
  for (double* coefficient : {&d.k1, &d.k2, &d.p1, &d.p2, &d.k3}) {
    *coefficient *= 1.0 + deviations.color_distortion * distortion.Normal(index++);
  }
  return CameraModel(built);
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
  built.cameras.color = Built(design.color, deviations, unit.Child("color"));
  built.cameras.depth = Built(design.depth, deviations, unit.Child("depth"));
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
  const auto set_camera = [&](const CameraModel& camera, Eigen::Index first) {
    // One factor for both focal lengths.
    const Eigen::Vector2d focal_px(camera.parameters().fx_px, camera.parameters().fy_px);
    covariance.block<2, 2>(first, first) =
        std::pow(deviations.focal_length, 2) * focal_px * focal_px.transpose();
    covariance.diagonal().segment<2>(first + 2).setConstant(
        std::pow(deviations.principal_point_px * ScaleOf(camera), 2));
  };
  set_camera(design.color, 0);
  set_camera(design.depth, kUnitDepthCamera);
  covariance.diagonal().segment<5>(4) =
      (deviations.color_distortion * design.color.ParameterVector().tail<5>()).cwiseAbs2();
  // A turn before X_KD also moves its translation, by turn x p_KD.
  const double turn2 = deviations.rotation_rad * deviations.rotation_rad;
  const Eigen::Matrix3d by_turn = -CrossMatrix(design.X_KD.translation());
  auto pose = covariance.block<6, 6>(kUnitPose, kUnitPose);
  pose.topLeftCorner<3, 3>().diagonal().setConstant(turn2);
  pose.bottomLeftCorner<3, 3>() = turn2 * by_turn;
  pose.topRightCorner<3, 3>() = turn2 * by_turn.transpose();
  pose.bottomRightCorner<3, 3>() =
      turn2 * by_turn * by_turn.transpose() +
      deviations.translation_m * deviations.translation_m * Eigen::Matrix3d::Identity();
  covariance(kUnitScale, kUnitScale) = std::pow(deviations.disparity_scale, 2);
  covariance(kUnitOffset, kUnitOffset) = std::pow(deviations.disparity_offset_px, 2);
  return covariance;
}

}  // namespace fenestra
