#include "vision/rgbd/pictures.h"

#include <opencv2/imgproc.hpp>

namespace fenestra {

cv::Mat3b DrawDepth(const cv::Mat1f& depth_m) {
  const cv::Mat1b seen = depth_m > 0.0f;
  cv::Mat3b drawn = cv::Mat3b::zeros(depth_m.size());
  if (cv::countNonZero(seen) == 0) return drawn;
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  cv::minMaxLoc(depth_m, &nearest_m, &farthest_m, nullptr, nullptr, seen);
  const double scale = -255.0 / std::max(farthest_m - nearest_m, 1e-3);
  cv::Mat1b nearness;
  depth_m.convertTo(nearness, CV_8U, scale, 255.0 - scale * nearest_m);
  cv::Mat3b colors;
  cv::applyColorMap(nearness, colors, cv::COLORMAP_TURBO);
  colors.copyTo(drawn, seen);
  return drawn;
}

cv::Mat3b DrawSegmentation(const RegisteredImages& images, const DarkCloud& cloud) {
  cv::Mat3b drawn = images.color.clone();
  const cv::Mat1b with_depth = cloud.depth_m > 0.0f;
  drawn.setTo(cv::Scalar(60, 60, 230), cloud.mask);
  drawn.setTo(cv::Scalar(80, 200, 80), with_depth);
  return drawn;
}

cv::Mat3b DrawKeyPoints(const cv::Mat1f& depth_m, const std::vector<KeyPoint>& key_points,
                        const std::optional<std::array<int, 4>>& chosen) {
  constexpr int kScale = kKeyPointPictureScale;
  cv::Mat3b drawn;
  cv::resize(DrawDepth(depth_m), drawn, {}, kScale, kScale, cv::INTER_NEAREST);
  const auto center = [](const KeyPoint& key_point) {
    return cv::Point(kScale * key_point.pixel.x() + kScale / 2,
                     kScale * key_point.pixel.y() + kScale / 2);
  };
  for (const KeyPoint& key_point : key_points) {
    cv::circle(drawn, center(key_point), 7, cv::Scalar(255, 255, 255), 2, cv::LINE_AA);
  }
  if (!chosen) return drawn;
  std::vector<cv::Point> outline;
  for (const int i : *chosen) outline.push_back(center(key_points[static_cast<size_t>(i)]));
  cv::polylines(drawn, outline, true, cv::Scalar(255, 0, 255), 2, cv::LINE_AA);
  return drawn;
}

cv::Mat3b DrawDepthUse(const DepthImage& depth, const FramePlanes& planes,
                       const DepthPointReader& reader) {
  cv::Mat1f depth_m;
  depth.raw.convertTo(depth_m, CV_32F, depth.unit_m);
  cv::Mat3b picture;
  DrawDepth(depth_m).convertTo(picture, CV_8U, 0.4);
  const auto mark = [&](const DepthPoint& point, const cv::Vec3b& colour) {
    const cv::Rect place =
        cv::Rect(point.pixel.x - reader.columns() / 2, point.pixel.y - reader.rows() / 2,
                 reader.columns(), reader.rows()) &
        cv::Rect({0, 0}, picture.size());
    picture(place).setTo(colour);
  };
  for (size_t i = 0; i < planes.points.wall.size(); ++i) {
    mark(planes.points.wall[i],
         planes.wall.is_inlier[i] ? cv::Vec3b(80, 200, 80) : cv::Vec3b(60, 60, 230));
  }
  for (const DepthPoint& point : planes.points.border) mark(point, {60, 220, 230});
  return picture;
}

}  // namespace fenestra
