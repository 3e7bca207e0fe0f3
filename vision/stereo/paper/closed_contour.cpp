#include "vision/stereo/paper/closed_contour.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

constexpr double kNearestGray = 64.0;
constexpr double kFarthestGray = 255.0;

// An open curve is traced there and back and encloses almost no area, a closed convex one encloses
// its whole hull, and a ragged one slightly less.
constexpr double kLeastShareOfHull = 0.8;

}  // namespace

cv::Mat1f DepthFromDisparity(const cv::Mat1f& disparity, const RectifiedCamera& camera) {
  cv::Mat1f depth_m;
  // cv::divide yields infinity for d = 0.
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
  // Eroding by a box twice as wide as the ring leaves the opening. The area outside the image
  // counts as empty, so that a hull at the image's border has a ring there, too.
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

cv::Mat1b DetectEdges(const cv::Mat1b& depth_gray, const CannyThresholds& thresholds) {
  cv::Mat1b padded;
  cv::copyMakeBorder(depth_gray, padded, kEdgeRim_px, kEdgeRim_px, kEdgeRim_px, kEdgeRim_px,
                     cv::BORDER_CONSTANT, 0);
  cv::Mat1b edges;
  cv::Canny(padded, edges, thresholds.low_dn, thresholds.high_dn);
  return edges;
}

std::optional<std::vector<cv::Point>> LargestClosedContour(const cv::Mat1b& edges) {
  // Where two edges meet, non-maximum suppression may leave a gap of a few pixels. Closing fills it
  // without moving a convex outline.
  cv::Mat1b joined;
  cv::morphologyEx(edges, joined, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(joined, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE,
                   {-kEdgeRim_px, -kEdgeRim_px});
  const std::vector<cv::Point>* largest = nullptr;
  double largest_px2 = 0.0;
  for (const std::vector<cv::Point>& contour : contours) {
    const double area_px2 = cv::contourArea(contour);
    if (area_px2 <= largest_px2) continue;
    largest = &contour;
    largest_px2 = area_px2;
  }
  if (largest == nullptr) return std::nullopt;
  std::vector<cv::Point> hull;
  cv::convexHull(*largest, hull);
  if (largest_px2 < kLeastShareOfHull * cv::contourArea(hull)) return std::nullopt;
  return *largest;
}

}  // namespace fenestra
