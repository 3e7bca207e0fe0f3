#include "vision/stereo/paper/stage_pictures.h"

#include <opencv2/imgproc.hpp>

#include "vision/stereo/paper/closed_contour.h"

namespace fenestra {

cv::Mat3b DrawDepth(const cv::Mat1f& depth_m, const DepthRange& range) {
  // Equal steps of colour are equal steps of 1/z, and so of disparity.
  cv::Mat1f inverse;
  cv::divide(1.0, depth_m, inverse);
  const double far = 1.0 / range.farthest_m;
  const double scale = 255.0 / (1.0 / range.nearest_m - far);
  cv::Mat1b gray;
  inverse.convertTo(gray, CV_8U, scale, -scale * far);
  cv::Mat3b picture;
  cv::applyColorMap(gray, picture, cv::COLORMAP_TURBO);
  picture.setTo(cv::Scalar::all(0), depth_m <= 0.0f);
  return picture;
}

cv::Mat1b DrawEdges(const cv::Mat1b& edges, const cv::Rect& box, const cv::Size& size) {
  cv::Mat1b whole(size.height + 2 * kEdgeRim_px, size.width + 2 * kEdgeRim_px, uint8_t{0});
  edges.copyTo(whole(cv::Rect(box.tl(), edges.size())));
  return whole(cv::Rect({kEdgeRim_px, kEdgeRim_px}, size)).clone();
}

}  // namespace fenestra
