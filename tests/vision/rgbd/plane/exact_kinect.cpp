#include "tests/vision/rgbd/plane/exact_kinect.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/io/srgb.h"

namespace fenestra::testing {
namespace {

uint8_t Encoded(double linear_dn) {
  return static_cast<uint8_t>(std::lround(255.0 * SrgbFromLinear(linear_dn / 255.0)));
}

// Standard normal variates, each the mean of those in a window around it.
cv::Mat1f WindowNoise(cv::Size size, double window_px, const RandomStream& stream) {
  // Windows are those of an image 640 pixels wide.
  const int scale = std::max(1, 640 / size.width);
  const int side = std::max(1, static_cast<int>(window_px * size.width * scale / 640.0));
  cv::Mat1f fine(size.height * scale + side, size.width * scale + side);
  stream.FillNormals({fine.ptr<float>(), fine.total()});
  cv::Mat1f sums;
  cv::boxFilter(fine, sums, CV_32F, {side, side}, {0, 0}, false);
  cv::Mat1f noise(size);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      noise(v, u) = sums(v * scale, u * scale) / static_cast<float>(side);
    }
  }
  return noise;
}

// Inverse depth of the plane z_O = offset_m along a ray.
double InverseDepth(const Pose& X_DO, double offset_m, const Eigen::Vector3d& ray_D) {
  const Eigen::Vector3d normal = X_DO.rotation().col(2);
  return normal.dot(ray_D) / (normal.dot(X_DO.translation()) + offset_m);
}

}  // namespace

ExactKinectPicture ExactPicture(const RgbdCalibration& calibration, const ExactKinectScene& scene) {
  const ExactFrame& frame = scene.frame;
  ExactKinectPicture picture;
  picture.linear_dn = ExactPicture(calibration.color, calibration.X_KD, frame);
  const CameraModel& depth = calibration.depth;
  picture.inverse_depth = cv::Mat1f::zeros(depth.height_px(), depth.width_px());
  for (int v = 0; v < depth.height_px(); ++v) {
    for (int u = 0; u < depth.width_px(); ++u) {
      const Eigen::Vector3d ray_D = *depth.UnprojectRay({u, v});
      const double front = InverseDepth(frame.X_LO, 0.0, ray_D);
      const Eigen::Vector3d p_O = frame.X_LO.inverse() * (ray_D / front);
      const double outside_m = std::max(std::abs(p_O.x()) - 0.5 * frame.width_m,
                                        std::abs(p_O.y()) - 0.5 * frame.height_m);
      double seen = InverseDepth(frame.X_LO, scene.setback_m, ray_D);
      if (outside_m < -frame.border_m) {
        seen = scene.opening_m < 0.0 ? 0.0 : InverseDepth(frame.X_LO, -scene.opening_m, ray_D);
      } else if (outside_m < 0.0) {
        seen = scene.frame_returns ? front : 0.0;
      }
      picture.inverse_depth(v, u) = static_cast<float>(std::max(0.0, seen));
    }
  }
  return picture;
}

RgbdObservation WithNoise(const ExactKinectPicture& picture, const RgbdCalibration& calibration,
                          const ExactKinectNoise& noise, const RandomStream& stream) {
  const cv::Size size = picture.linear_dn.size();
  cv::Mat3f grain(size);
  stream.Child("color").FillNormals({grain.ptr<float>(), 3 * grain.total()});
  RgbdObservation seen{.color = cv::Mat3b(size),
                       .depth = {.raw = cv::Mat1w::zeros(picture.inverse_depth.size()),
                                 .unit_m = calibration.depth_unit_m}};
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      for (int i = 0; i < 3; ++i) {
        seen.color(v, u)[i] = Encoded(picture.linear_dn(v, u) + noise.color_dn * grain(v, u)[i]);
      }
    }
  }
  const cv::Mat1f errors =
      WindowNoise(picture.inverse_depth.size(), noise.window_px, stream.Child("depth"));
  for (int v = 0; v < errors.rows; ++v) {
    for (int u = 0; u < errors.cols; ++u) {
      if (picture.inverse_depth(v, u) == 0.0f) continue;
      double measured = picture.inverse_depth(v, u) + noise.inverse_depth * errors(v, u);
      if (noise.step > 0.0) measured = noise.step * std::round(measured / noise.step);
      if (!(measured > 0.0)) continue;
      seen.depth.raw(v, u) = cv::saturate_cast<uint16_t>(1.0 / measured / calibration.depth_unit_m);
    }
  }
  return seen;
}

}  // namespace fenestra::testing
