#include "vision/frame/detection/quadrilateral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/stereo/paper/closed_contour.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;

Quadrilateral Turned(double angle_rad, double half_px, const Vector2d& centre) {
  const double c = half_px * std::cos(angle_rad);
  const double s = half_px * std::sin(angle_rad);
  return {centre + Vector2d(-c + s, -s - c), centre + Vector2d(c + s, s - c),
          centre + Vector2d(c - s, s + c), centre + Vector2d(-c - s, -s + c)};
}

// 8-bit depth image whose pixels are set where their centre is inside.
cv::Mat1b Draw(const Quadrilateral& q) {
  cv::Mat1b image(240, 320, uint8_t{0});
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      bool inside = true;
      for (size_t i = 0; i < 4; ++i) {
        const Vector2d side = q[(i + 1) % 4] - q[i];
        const Vector2d offset = Vector2d(u, v) - q[i];
        inside = inside && side.x() * offset.y() - side.y() * offset.x() >= 0.0;
      }
      if (inside) image(v, u) = 100;
    }
  }
  return image;
}

std::optional<Quadrilateral> Find(const cv::Mat1b& image) {
  const auto contour = LargestClosedContour(DetectEdges(image, {60.0, 120.0}));
  if (!contour) return std::nullopt;
  auto q = FitQuadrilateral(*contour);
  for (size_t i = 0; q && i < 4; ++i) (*q)[i].array() += 0.5;
  return q;
}

TEST(Quadrilateral, CornersOfADrawnSquareAreFoundToAPixel) {
  Vector2d sum = Vector2d::Zero();
  int count = 0;
  for (double angle_deg = -20.0; angle_deg <= 20.0; angle_deg += 2.5) {
    const Quadrilateral truth =
        Turned(angle_deg * std::numbers::pi / 180.0, 60.0, {160.3 + 0.01 * angle_deg, 119.6});
    const auto found = Find(Draw(truth));
    ASSERT_TRUE(found) << angle_deg;
    for (size_t i = 0; i < 4; ++i) {
      // Two lines through pixels that are off by half a pixel at most.
      EXPECT_LT(((*found)[i] - truth[i]).norm(), 0.71) << angle_deg;
      sum += (*found)[i] - truth[i];
      ++count;
    }
  }
  // Without ties in Canny's suppression the half pixel that is added would be a bias of 0.71, with
  // ties everywhere it would be none; slanted edges are in between.
  EXPECT_LT((sum / count).norm(), 0.36);
}

TEST(Quadrilateral, UprightRectangleIsFoundWithoutBias) {
  cv::Mat1b image(240, 320, uint8_t{0});
  image(cv::Rect(80, 60, 150, 120)) = 100;  // Its borders are at 79.5, 59.5, 229.5 and 179.5.
  const auto found = Find(image);
  ASSERT_TRUE(found);
  // cv::fitLine iterates to 0.01 px; both ends of a diagonal shift together if there is a bias.
  EXPECT_LT(((*found)[0] - Vector2d(79.5, 59.5)).norm(), 0.05);
  EXPECT_LT(((*found)[2] - Vector2d(229.5, 179.5)).norm(), 0.05);
}

TEST(Quadrilateral, InsetUndoesDilationByASquare) {
  for (double angle_deg : {0.0, 7.0, -18.0}) {
    const cv::Mat1b image =
        Draw(Turned(angle_deg * std::numbers::pi / 180.0, 60.0, {160.0, 120.0}));
    cv::Mat1b fat;
    cv::dilate(image, fat, cv::getStructuringElement(cv::MORPH_RECT, {15, 15}));
    const auto lean = Find(image);
    auto found = Find(fat);
    ASSERT_TRUE(lean && found);
    found = Inset(*found, 7.0);
    ASSERT_TRUE(found);
    for (size_t i = 0; i < 4; ++i) EXPECT_LT(((*found)[i] - (*lean)[i]).norm(), 1.0) << angle_deg;
  }
}

TEST(Quadrilateral, InsetBeyondTheCentreLeavesNothing) {
  const Quadrilateral q = Turned(0.1, 20.0, {160.0, 120.0});
  EXPECT_TRUE(Inset(q, 10.0));
  EXPECT_FALSE(Inset(q, 20.0));
  EXPECT_FALSE(Inset(q, 100.0));
}

TEST(Quadrilateral, CornersComeClockwiseFromTopLeft) {
  const auto found = Find(Draw(Turned(0.2, 50.0, {150.0, 110.0})));
  ASSERT_TRUE(found);
  EXPECT_LT((*found)[0].x(), (*found)[1].x());
  EXPECT_LT((*found)[1].y(), (*found)[2].y());
  EXPECT_GT((*found)[2].x(), (*found)[3].x());
  EXPECT_NEAR(Area(*found), 1e4, 0.02 * 1e4);
}

}  // namespace
}  // namespace fenestra
