#include "vision/frame/setback/parallax_edges.h"

#include <gtest/gtest.h>

#include "tests/vision/frame/exact_frame.h"
#include "tests/vision/stereo/stereo_scene.h"

namespace fenestra {
namespace {

using testing::ExactFrame;
using testing::ExactPair;
using testing::PaperRig;
using testing::WindowSeenFrom;

constexpr double kSetback_m = 0.10;

// Seen from the left, so that its right reveal is in view and its left side behind the wall's edge.
ExactFrame SetBackFrame() {
  ExactFrame frame{.X_LO = WindowSeenFrom({.distance_m = 3.0, .azimuth_deg = 30.0})};
  frame.setback_m = kSetback_m;
  frame.opening_dn = 40.0;
  return frame;
}

// The wall's edge around it.
FrameRectangle WallRectangle(const ExactFrame& frame) {
  FrameRectangle rectangle;
  rectangle.R_LO = frame.X_LO.rotation();
  rectangle.p_LO = frame.X_LO * Eigen::Vector3d(0.0, 0.0, kSetback_m);
  rectangle.width_m = frame.width_m;
  rectangle.height_m = frame.height_m;
  return rectangle;
}

std::vector<ParallaxEdge> EdgesOf(Side side, const StereoCalibration& rig,
                                  const StereoObservation& seen, const ExactFrame& frame) {
  return FindParallaxEdges({rig.left, Pose(), seen.left}, {rig.right, rig.X_RL, seen.right},
                           WallRectangle(frame), side);
}

TEST(ParallaxEdges, AreWhereTheWallsTheFramesAndTheOpeningsEdgesAre) {
  const StereoCalibration rig = PaperRig();
  const ExactFrame frame = SetBackFrame();
  const StereoObservation seen = ExactPair(rig, frame, 1.0, RandomStream(1));
  int of_wall = 0;
  int of_front = 0;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    for (const ParallaxEdge& edge : EdgesOf(side, rig, seen, frame)) {
      // Edges of two depths in one window are a few hundredths of a pixel off, which is as many
      // centimetres · 9 / (667 · 0.35) here.
      const double tolerance_m = 4.0 * edge.sigma_m + edge.crowding_m + 0.004;
      const bool on_wall = std::abs(edge.behind_m) < tolerance_m;
      const bool on_front = std::abs(edge.behind_m - kSetback_m) < tolerance_m;
      EXPECT_TRUE(on_wall != on_front) << edge.behind_m;
      if (on_wall) {
        EXPECT_NEAR(edge.inset_m, 0.0, 0.005);
      }
      if (on_front) {
        EXPECT_LT(std::min(std::abs(edge.inset_m), std::abs(edge.inset_m - frame.border_m)),
                  0.010 + tolerance_m);
      }
      of_wall += on_wall;
      of_front += on_front;
    }
  }
  EXPECT_EQ(of_wall, 2);
  EXPECT_GE(of_front, 2);
}

TEST(ParallaxEdges, OneViewTwiceHasNone) {
  const StereoCalibration rig = PaperRig();
  const ExactFrame frame = SetBackFrame();
  const StereoObservation seen = ExactPair(rig, frame, 1.0, RandomStream(1));
  const CameraView left{rig.left, Pose(), seen.left};
  EXPECT_TRUE(FindParallaxEdges(left, left, WallRectangle(frame), Side::kLeft).empty());
}

}  // namespace
}  // namespace fenestra
