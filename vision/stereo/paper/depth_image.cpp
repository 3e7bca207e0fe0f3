#include "vision/stereo/paper/depth_image.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

constexpr double kNearestGray = 64.0;
constexpr double kFarthestGray = 255.0;

}  // namespace

cv::Mat1f DepthFromDisparity(const cv::Mat1f& disparity, const RectifiedCamera& camera) {
  cv::Mat1f depth_m;
  // cv::divide of floats gives infinity for d = 0.
  cv::divide(camera.f_px * camera.baseline_m, disparity, depth_m);
  depth_m.setTo(0.0f, disparity <= 0.0f);
  return depth_m;
}

cv::Mat1b ToEightBit(const cv::Mat1f& depth_m, const DepthRange& range) {
  const double scale = (kFarthestGray - kNearestGray) / (range.farthest_m - range.nearest_m);
  cv::Mat1b gray;
  depth_m.convertTo(gray, CV_8U, scale, kNearestGray - scale * range.nearest_m);
  gray.setTo(0, depth_m <= 0.0f);
  return gray;
}

cv::Mat1f DepthPatch::In(const cv::Size& size) const {
  cv::Mat1f whole(size, 0.0f);
  depth_m.copyTo(whole(box));
  return whole;
}

DepthPatch CloseGaps(const cv::Mat1f& disparity, const std::vector<cv::Point>& hull,
                     const DisparityPlane& plane, double plane_tolerance_px, int thickness_px,
                     const RectifiedCamera& camera) {
  const cv::Rect box = cv::boundingRect(hull) & cv::Rect({0, 0}, disparity.size());
  std::vector<cv::Point> hull_in_box;
  for (const cv::Point& p : hull) hull_in_box.push_back(p - box.tl());
  cv::Mat1b filled(box.size(), 0);
  cv::fillConvexPoly(filled, hull_in_box, 255);
  // Eroding by a box twice the ring's thickness wide leaves the opening; outside nothing is filled,
  // so that a hull at the image's border has a ring there, too.
  cv::Mat1b opening;
  const int side = 2 * thickness_px + 1;
  cv::erode(filled, opening, cv::getStructuringElement(cv::MORPH_RECT, {side, side}), {-1, -1}, 1,
            cv::BORDER_CONSTANT, cv::Scalar(0));
  DepthPatch closed{.box = box, .depth_m = cv::Mat1f(box.size(), 0.0f)};
  for (int v = 0; v < box.height; ++v) {
    for (int u = 0; u < box.width; ++u) {
      if (filled(v, u) == 0) continue;
      const double d = plane.At({box.x + u, box.y + v});
      const float matched = disparity(box.y + v, box.x + u);
      const bool on_plane = matched > 0.0f && std::abs(matched - d) <= plane_tolerance_px;
      if (d > 0.0 && (opening(v, u) == 0 || on_plane)) {
        closed.depth_m(v, u) = static_cast<float>(camera.DepthFromDisparity(d));
      }
    }
  }
  return closed;
}

}  // namespace fenestra
