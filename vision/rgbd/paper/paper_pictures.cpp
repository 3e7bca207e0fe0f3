#include "vision/rgbd/paper/paper_pictures.h"

#include <opencv2/imgproc.hpp>

#include "vision/rgbd/rgbd_images.h"

namespace fenestra {

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

}  // namespace fenestra
