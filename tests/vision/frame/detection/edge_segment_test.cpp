#include "vision/frame/detection/edge_segment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr EdgeSegmentSettings kChainSettings{
    .min_length_px = 12.0,
    .min_darkness = 0.25,
    .most_per_side = 60,
    .darkness = {.black_dn = 8.0, .min_contrast_dn = 6.0, .reach_px = 4.0}};
constexpr double kBlur_px = 0.9;  // A lens' and a pixel's together.

// A straight line through the image's middle; `normal` points from the dark to the bright.
struct Line {
  double angle_deg;
  double offset_px;

  Vector2d normal() const {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    return {std::cos(angle), std::sin(angle)};
  }
  double Distance(const Vector2d& pixel) const {
    return normal().dot(pixel - Vector2d(99.5, 79.5)) - offset_px;
  }
};

// Grey values as a blurred step has them; of several lines the bright side is that of any.
cv::Mat1b DrawEdges(const std::vector<Line>& lines, double dark_dn, double bright_dn) {
  cv::Mat1b image(160, 200);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      double largest = -1e9;
      for (const Line& line : lines) largest = std::max(largest, line.Distance({u, v}));
      const double bright = 0.5 * std::erfc(-largest / (kBlur_px * std::numbers::sqrt2));
      image(v, u) = cv::saturate_cast<uchar>(dark_dn + bright * (bright_dn - dark_dn));
    }
  }
  return image;
}

size_t Count(const EdgeSegments& segments) {
  size_t count = 0;
  for (const auto& side : segments) count += side.size();
  return count;
}

const std::vector<EdgeSegment>& Of(const EdgeSegments& segments, Side side) {
  return segments[static_cast<size_t>(side)];
}

// Signed distance of a point from a segment's line, positive on its right.
double OnTheRight(const EdgeSegment& segment, const Vector2d& p) {
  const Vector2d along = (segment.to - segment.from).normalized();
  return Vector2d(-along.y(), along.x()).dot(p - segment.from);
}

// The dark is to the left of a right side's edge, above a bottom side's, and so on.
TEST(EdgeChains, AnEdgeIsListedOnTheSideThatItMayBeWithTheDarkOnItsRight) {
  const std::array<std::pair<double, Side>, 4> cases = {
      {{3.0, Side::kRight}, {93.0, Side::kBottom}, {183.0, Side::kLeft}, {273.0, Side::kTop}}};
  for (const auto& [angle_deg, side] : cases) {
    const Line line{angle_deg, 1.3};
    const EdgeSegments segments = FollowEdges(DrawEdges({line}, 20.0, 150.0), kChainSettings);
    ASSERT_EQ(Count(segments), 1u) << angle_deg;
    ASSERT_EQ(Of(segments, side).size(), 1u) << angle_deg;
    const EdgeSegment& found = Of(segments, side).front();
    const Vector2d in_the_dark = Vector2d(99.5, 79.5) - 20.0 * line.normal();
    EXPECT_GT(OnTheRight(found, in_the_dark), 15.0) << angle_deg;
    EXPECT_EQ(found.darkness, 0.0);
  }
}

// A parabola through three values of a Gaussian of this width has its vertex within 0.05 px of the
// Gaussian's, whatever its place between pixels. Rounding adds less, and a line averages over
// places.
TEST(EdgeChains, EdgesAreFoundToAFractionOfAPixel) {
  for (const double angle_deg : {0.0, 2.0, 11.0, 30.0, 40.0}) {
    for (const double offset_px : {0.0, 0.2, 0.5, 0.7}) {
      const Line line{angle_deg, offset_px};
      const EdgeSegments segments = FollowEdges(DrawEdges({line}, 20.0, 150.0), kChainSettings);
      ASSERT_GE(Of(segments, Side::kRight).size(), 1u) << angle_deg;
      const EdgeSegment& found = Of(segments, Side::kRight).front();
      EXPECT_NEAR(line.Distance(found.from), 0.0, 0.06) << angle_deg << ", " << offset_px;
      EXPECT_NEAR(line.Distance(found.to), 0.0, 0.06) << angle_deg << ", " << offset_px;
      // From the second row to the last but one.
      EXPECT_NEAR(std::abs(found.from.y() - found.to.y()), 157.0, 1.0);
    }
  }
}

TEST(EdgeChains, TransposingThePictureTransposesItsEdges) {
  const cv::Mat1b image = DrawEdges({{17.0, 0.3}, {130.0, 20.0}}, 20.0, 150.0);
  const EdgeSegments upright = FollowEdges(image, kChainSettings);
  const EdgeSegments lying = FollowEdges(image.t(), kChainSettings);
  ASSERT_GE(Count(upright), 2u);
  // Mirroring at the diagonal turns a walk clockwise into one counterclockwise.
  const std::array<Side, 4> mirrored = {Side::kLeft, Side::kBottom, Side::kRight, Side::kTop};
  for (const Side side : kAllSides) {
    const auto& before = Of(upright, side);
    const auto& after = Of(lying, mirrored[static_cast<size_t>(side)]);
    ASSERT_EQ(before.size(), after.size());
    for (size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(before[i].from, after[i].to.reverse());
      EXPECT_EQ(before[i].to, after[i].from.reverse());
    }
  }
}

TEST(EdgeChains, AChainIsSplitWhereItBends) {
  // Two upright edges that meet in the image's middle at an angle of 20°: 25 px to either side of
  // the bend, the chord between the ends is far more than 0.8 px off.
  const EdgeSegments segments =
      FollowEdges(DrawEdges({{10.0, 0.0}, {-10.0, 0.0}}, 20.0, 150.0), kChainSettings);
  ASSERT_EQ(Of(segments, Side::kRight).size(), 2u);
  for (const EdgeSegment& found : Of(segments, Side::kRight)) {
    EXPECT_NEAR(found.Length(), 78.0 / std::cos(10.0 * std::numbers::pi / 180.0), 4.0);
    const Vector2d middle = 0.5 * (found.from + found.to);
    EXPECT_LT(std::min(std::abs(Line{10.0, 0.0}.Distance(middle)),
                       std::abs(Line{-10.0, 0.0}.Distance(middle))),
              0.3);
  }
}

TEST(EdgeChains, ABendOfLessThanAPixelIsStraight) {
  const EdgeSegments segments =
      FollowEdges(DrawEdges({{0.5, 0.0}, {-0.5, 0.0}}, 20.0, 150.0), kChainSettings);
  EXPECT_EQ(Of(segments, Side::kRight).size(), 1u);
}

TEST(EdgeChains, WhatIsWeakerThanNoiseIsNoEdge) {
  EXPECT_EQ(Count(FollowEdges(DrawEdges({{0.0, 0.0}}, 20.0, 24.0), kChainSettings)), 0u);
  EXPECT_EQ(Count(FollowEdges(DrawEdges({{0.0, 0.0}}, 20.0, 40.0), kChainSettings)), 1u);
}

// Twenty grey values part light from dark in the shade and are texture of a sunlit wall.
TEST(EdgeChains, ContrastIsJudgedByTheLight) {
  EXPECT_EQ(Count(FollowEdges(DrawEdges({{0.0, 0.0}}, 40.0, 60.0), kChainSettings)), 1u);
  EXPECT_EQ(Count(FollowEdges(DrawEdges({{0.0, 0.0}}, 180.0, 200.0), kChainSettings)), 0u);
}

TEST(EdgeChains, ShortEdgesAreLeftOut) {
  cv::Mat1b image(160, 200, uchar{150});
  image(cv::Rect(60, 70, 80, 8)) = 20;
  const EdgeSegments segments = FollowEdges(image, kChainSettings);
  EXPECT_EQ(Of(segments, Side::kTop).size(), 1u);
  EXPECT_EQ(Of(segments, Side::kBottom).size(), 1u);
  EXPECT_TRUE(Of(segments, Side::kLeft).empty());
  EXPECT_TRUE(Of(segments, Side::kRight).empty());
}

}  // namespace
}  // namespace fenestra
