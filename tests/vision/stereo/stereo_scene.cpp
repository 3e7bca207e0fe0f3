#include "tests/vision/stereo/stereo_scene.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/geometry/pose.h"

namespace fenestra::testing {
namespace {

constexpr int kSamples = 8;  // Squared, in pixels that an edge crosses.

class FrameProbe {
 public:
  FrameProbe(const CameraModel& camera, const Pose& X_CO, const PlanarTarget& target)
      : camera_(camera), X_OC_(X_CO.inverse()), target_(target) {}

  bool OnBorder(double u, double v) const {
    const auto ray_C = camera_.UnprojectRay({u, v});
    if (!ray_C) return false;
    const Eigen::Vector3d ray_O = X_OC_.rotation() * *ray_C;
    const double depth_m = -X_OC_.translation().z() / ray_O.z();
    if (!(depth_m > 0.0)) return false;
    const Eigen::Vector3d p_OQ = X_OC_.translation() + depth_m * ray_O;
    const double reach_m = std::max(std::abs(p_OQ.x()), std::abs(p_OQ.y()));
    const double outer_m = 0.5 * target_.outer_side_m;
    return reach_m <= outer_m && reach_m >= outer_m - target_.border_m;
  }

 private:
  const CameraModel& camera_;
  Pose X_OC_;
  PlanarTarget target_;
};

// BorderCoverage of the support library, with samples only in pixels whose corners differ: the
// border is several pixels wide in all these tests.
cv::Mat1f Coverage(const CameraModel& camera, const FrameProbe& probe) {
  cv::Mat1b corner(camera.height_px() + 1, camera.width_px() + 1);
  for (int v = 0; v < corner.rows; ++v) {
    for (int u = 0; u < corner.cols; ++u) corner(v, u) = probe.OnBorder(u - 0.5, v - 0.5) ? 1 : 0;
  }
  cv::Mat1f coverage(camera.height_px(), camera.width_px());
  for (int v = 0; v < coverage.rows; ++v) {
    for (int u = 0; u < coverage.cols; ++u) {
      const int sum = corner(v, u) + corner(v, u + 1) + corner(v + 1, u) + corner(v + 1, u + 1);
      coverage(v, u) = static_cast<float>(sum) / 4.0f;
      if (sum == 0 || sum == 4) continue;
      int inside = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        inside += probe.OnBorder(u - 0.5 + (i % kSamples + 0.5) / kSamples,
                                 v - 0.5 + (i / kSamples + 0.5) / kSamples);
      }
      coverage(v, u) = static_cast<float>(inside) / (kSamples * kSamples);
    }
  }
  return coverage;
}

cv::Mat1b Expose(const cv::Mat1f& coverage, const Photo& photo, const RandomStream& stream) {
  cv::Mat1f image = photo.wall_dn + coverage * (photo.frame_dn - photo.wall_dn);
  if (photo.blur_px > 0.0) cv::GaussianBlur(image, image, {}, photo.blur_px);
  cv::Mat1f noise(image.size());
  stream.FillNormals({noise.ptr<float>(), noise.total()});
  image += photo.noise_dn * noise;
  cv::Mat1b quantised;
  image.convertTo(quantised, CV_8U);
  return quantised;
}

Pose Turn(double x_deg, double y_deg, double z_deg) {
  return Pose(RotationFromVector(kDegree * Eigen::Vector3d(x_deg, y_deg, z_deg)),
              Eigen::Vector3d::Zero());
}

}  // namespace

StereoCalibration PaperRig(const BrownConrady& distortion,
                           const Eigen::Vector3d& right_rotation_rad, double baseline_m) {
  CameraParameters camera = CameraModel::Pinhole(752, 480, 4e-3 / 6e-6).parameters();
  camera.distortion = distortion;
  return {CameraModel(camera), CameraModel(camera),
          Pose(RotationFromVector(right_rotation_rad), Eigen::Vector3d::Zero()) *
              Pose::Translation({-baseline_m, 0.0, 0.0})};
}

Pose WindowSeenFrom(const View& view, double baseline_m) {
  return Pose::Translation({0.5 * baseline_m, 0.0, 0.0}) * Turn(0.0, 0.0, view.roll_deg) *
         Turn(view.pitch_deg, 0.0, 0.0) * Turn(0.0, view.yaw_deg, 0.0) *
         FacingWindow(view.distance_m) * Turn(0.0, view.azimuth_deg, 0.0);
}

StereoObservation Photograph(const StereoCalibration& rig, const Pose& X_LO,
                             const PlanarTarget& target, const Photo& photo,
                             const RandomStream& stream) {
  const FrameProbe left(rig.left, X_LO, target);
  const FrameProbe right(rig.right, rig.X_RL * X_LO, target);
  return {Expose(Coverage(rig.left, left), photo, stream.Child("noise", 0)),
          Expose(Coverage(rig.right, right), photo, stream.Child("noise", 1))};
}

EdgeStereoOptions OptionsForExactPictures() {
  EdgeStereoOptions options;
  options.edge_shift = {.centre_px = 0.0004, .corner_px = 0.0004};
  return options;
}

}  // namespace fenestra::testing
