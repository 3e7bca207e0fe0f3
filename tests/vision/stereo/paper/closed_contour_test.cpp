#include "vision/stereo/paper/closed_contour.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

namespace fenestra {
namespace {

TEST(ClosedContour, AnOpenCurveIsNoContour) {
  cv::Mat1b edges(240, 320, uint8_t{0});
  cv::polylines(edges, std::vector<cv::Point>{{50, 50}, {200, 50}, {200, 180}}, false, 255);
  EXPECT_FALSE(LargestClosedContour(edges));
  EXPECT_FALSE(LargestClosedContour(cv::Mat1b(1, 1, uint8_t{0})));
}

TEST(ClosedContour, ASurfaceThatFillsTheImageIsClosedAtItsBorder) {
  const auto contour = LargestClosedContour(DetectEdges(cv::Mat1b(50, 60, 100), {60.0, 120.0}));
  ASSERT_TRUE(contour);
  EXPECT_EQ(cv::boundingRect(*contour), cv::Rect(-1, -1, 61, 51));
}

}  // namespace
}  // namespace fenestra
