#include "vision/stereo/edge/frame_seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr RectifiedCamera kCamera{
    .f_px = 500.0, .cx_px = 320.0, .cy_px = 240.0, .baseline_m = 0.35};
constexpr DarknessSettings kDarkness{.black_dn = 8.0, .min_contrast_dn = 6.0, .reach_px = 4.0};
using Corners = std::array<Vector3d, 4>;

// A window 1.2 m wide and 1 m high, turned about its upright axis.
Corners Window(double z_m, double turn_rad = 0.0) {
  Corners p_FV;
  for (size_t i = 0; i < 4; ++i) {
    const double x = (i == 1 || i == 2 ? 0.6 : -0.6);
    const double y = (i < 2 ? -0.5 : 0.5);
    p_FV[i] = {0.15 + std::cos(turn_rad) * x, y, z_m + std::sin(turn_rad) * x};
  }
  return p_FV;
}

Quadrilateral Seen(const Corners& p_FV, double baseline_m) {
  Quadrilateral corners;
  for (size_t i = 0; i < 4; ++i) {
    const Vector3d p = p_FV[i] - Vector3d(baseline_m, 0.0, 0.0);
    corners[i] = {kCamera.cx_px + kCamera.f_px * p.x() / p.z(),
                  kCamera.cy_px + kCamera.f_px * p.y() / p.z()};
  }
  return corners;
}

Quadrilateral SeenLeft(const Corners& p_FV) {
  return Seen(p_FV, 0.0);
}
Quadrilateral SeenRight(const Corners& p_FV) {
  return Seen(p_FV, kCamera.baseline_m);
}

EdgeSegments EdgesOf(const Quadrilateral& corners) {
  EdgeSegments edges;
  for (size_t i = 0; i < 4; ++i) edges[i].push_back({corners[i], corners[(i + 1) % 4], 0.9});
  return edges;
}

DarkQuadrilateral DarkOf(const Quadrilateral& corners) {
  DarkQuadrilateral dark{.corners_px = corners, .clarity = 0.9, .length_px = 0.0};
  for (size_t i = 0; i < 4; ++i) dark.length_px += (corners[(i + 1) % 4] - corners[i]).norm();
  return dark;
}

cv::Mat1b Drawn(const Quadrilateral& corners) {
  cv::Mat1b image(480, 640, uchar{150});
  std::vector<cv::Point> outline;
  for (const Vector2d& corner : corners) {
    outline.emplace_back(cvRound(corner.x()), cvRound(corner.y()));
  }
  cv::fillConvexPoly(image, outline, 20);
  return image;
}

std::vector<FrameSeed> SeedsOf(const Corners& window, const EdgeSegments& right_edges,
                               const FrameLimits& limits = {}) {
  return FindSeeds(DarkOf(SeenLeft(window)), right_edges, Drawn(SeenRight(window)), kCamera, limits,
                   kDarkness);
}

TEST(FrameSeed, ExactEdgesGiveTheWindowsCornersInSpace) {
  for (const double turn_rad : {0.0, 0.4, -0.6}) {
    const Corners window = Window(3.0, turn_rad);
    const auto seeds = SeedsOf(window, EdgesOf(SeenRight(window)));
    ASSERT_EQ(seeds.size(), 1u) << turn_rad;
    for (size_t i = 0; i < 4; ++i) {
      EXPECT_LT((seeds[0].p_FV[i] - window[i]).norm(), 1e-9) << turn_rad;
    }
    EXPECT_GT(seeds[0].clarity, 0.8);
    const double right_px = DarkOf(SeenRight(window)).length_px;
    EXPECT_NEAR(seeds[0].length_px, DarkOf(SeenLeft(window)).length_px + right_px, 1e-9);
  }
}

TEST(FrameSeed, CornersAreInTheMeanOfBothViewsRows) {
  const Corners window = Window(3.0);
  Quadrilateral right = SeenRight(window);
  for (Vector2d& corner : right) corner.y() += 1.0;
  const auto seeds = SeedsOf(window, EdgesOf(right));
  ASSERT_EQ(seeds.size(), 1u);
  for (size_t i = 0; i < 4; ++i) {
    const double row_px = kCamera.f_px * seeds[0].p_FV[i].y() / seeds[0].p_FV[i].z();
    EXPECT_NEAR(row_px, kCamera.f_px * window[i].y() / 3.0 + 0.5, 1e-9);
  }
}

TEST(FrameSeed, WithoutALevelEdgeOnTheRightTheLeftRowsCount) {
  const Corners window = Window(3.0);
  EdgeSegments edges = EdgesOf(SeenRight(window));
  edges[static_cast<size_t>(Side::kTop)].clear();
  const auto seeds = SeedsOf(window, edges);
  ASSERT_EQ(seeds.size(), 1u);
  for (size_t i = 0; i < 4; ++i) EXPECT_LT((seeds[0].p_FV[i] - window[i]).norm(), 1e-9);
}

TEST(FrameSeed, EdgesOfOtherRowsAreNoMatch) {
  const Corners window = Window(3.0);
  EdgeSegments edges = EdgesOf(SeenRight(window));
  // The left edge ends where the window's begins.
  for (EdgeSegment& s : edges[static_cast<size_t>(Side::kLeft)]) {
    s.from.y() -= 170.0;
    s.to.y() -= 170.0;
  }
  EXPECT_TRUE(SeedsOf(window, edges).empty());
}

TEST(FrameSeed, WhatIsNearerFartherOrLargerThanTheLimitsIsNone) {
  const Corners window = Window(3.0);
  const EdgeSegments edges = EdgesOf(SeenRight(window));
  EXPECT_TRUE(SeedsOf(window, edges, {.nearest_m = 3.2}).empty());
  EXPECT_TRUE(SeedsOf(window, edges, {.farthest_m = 2.8}).empty());
  EXPECT_TRUE(SeedsOf(window, edges, {.max_side_m = 0.9}).empty());
}

TEST(FrameSeed, WhatIsNotDarkInTheRightImageIsNone) {
  const Corners window = Window(3.0);
  const cv::Mat1b bright(480, 640, uchar{150});
  EXPECT_TRUE(FindSeeds(DarkOf(SeenLeft(window)), EdgesOf(SeenRight(window)), bright, kCamera, {},
                        kDarkness)
                  .empty());
}

TEST(FrameSeed, OfNearlyTheSameTheClearestIsKept) {
  std::vector<FrameSeed> seeds = {{Window(3.0), 0.6, 100.0},
                                  {Window(3.02), 0.8, 100.0},
                                  {Window(4.0), 0.7, 100.0},
                                  {Window(5.0), 0.5, 100.0}};
  const auto kept = ClearestSeeds(seeds, 10);
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].clarity, 0.8);
  EXPECT_EQ(kept[1].clarity, 0.7);
  EXPECT_EQ(kept[2].clarity, 0.5);
  EXPECT_EQ(ClearestSeeds(seeds, 2).size(), 2u);
}

TEST(FrameSeed, OfEquallyClearOnesThatWithLongerEdgesComesFirst) {
  const auto kept = ClearestSeeds({{Window(3.0), 1.0, 100.0}, {Window(4.0), 1.0, 200.0}}, 1);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].length_px, 200.0);
}

}  // namespace
}  // namespace fenestra
