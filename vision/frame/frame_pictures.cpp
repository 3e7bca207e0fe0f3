#include "vision/frame/frame_pictures.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

cv::Point Rounded(const Eigen::Vector2d& p) {
  return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
}

}  // namespace

cv::Mat3b DrawSegments(const cv::Mat1b& image, const EdgeSegments& segments,
                       const std::vector<DarkQuadrilateral>& candidates) {
  cv::Mat3b picture;
  cv::cvtColor(image, picture, cv::COLOR_GRAY2BGR);
  const std::array<cv::Scalar, 4> colours = {
      cv::Scalar{0, 0, 255}, {0, 255, 255}, {255, 255, 0}, {255, 0, 0}};
  for (size_t side = 0; side < 4; ++side) {
    for (const EdgeSegment& s : segments[side]) {
      cv::line(picture, Rounded(s.from), Rounded(s.to), colours[side]);
    }
  }
  for (const DarkQuadrilateral& candidate : candidates) {
    for (size_t i = 0; i < 4; ++i) {
      cv::line(picture, Rounded(candidate.corners_px[i]),
               Rounded(candidate.corners_px[(i + 1) % 4]), {255, 0, 255});
    }
  }
  return picture;
}

cv::Mat3b DrawEdgePoints(std::span<const CameraView> views, const FrameFit& fit) {
  std::vector<cv::Mat> images;
  for (const CameraView& view : views) images.push_back(view.image);
  cv::Mat1b all;
  cv::hconcat(images, all);
  cv::Mat3b picture;
  cv::cvtColor(all, picture, cv::COLOR_GRAY2BGR);
  cv::Point corner(0, 0);
  for (size_t view = 0; view < views.size(); ++view) {
    for (size_t i = 0; i < fit.points[view].size(); ++i) {
      const cv::Scalar colour =
          fit.adjustment.is_inlier[view][i] ? cv::Scalar(80, 220, 80) : cv::Scalar(60, 60, 255);
      cv::circle(picture, corner + Rounded(fit.points[view][i].pixel), 1, colour, cv::FILLED);
    }
    corner.x += views[view].image.cols;
  }
  return picture;
}

}  // namespace fenestra
