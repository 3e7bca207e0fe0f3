#include "vision/rgbd/depth_picture.h"

#include <algorithm>
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

}  // namespace fenestra
