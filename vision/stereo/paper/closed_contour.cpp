#include "vision/stereo/paper/closed_contour.h"

#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

// An open curve is traced there and back and encloses next to nothing, a closed convex one all of
// its hull; a ragged one somewhat less.
constexpr double kLeastShareOfHull = 0.8;

}  // namespace

cv::Mat1b DetectEdges(const cv::Mat1b& depth_gray, const CannyThresholds& thresholds) {
  cv::Mat1b padded;
  cv::copyMakeBorder(depth_gray, padded, kEdgeRim_px, kEdgeRim_px, kEdgeRim_px, kEdgeRim_px,
                     cv::BORDER_CONSTANT, 0);
  cv::Mat1b edges;
  cv::Canny(padded, edges, thresholds.low_dn, thresholds.high_dn);
  return edges;
}

std::optional<std::vector<cv::Point>> LargestClosedContour(const cv::Mat1b& edges) {
  // Where two edges meet, non-maximum suppression may leave a gap of a few pixels. A
  // closing fills it and moves nothing of a convex outline.
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
