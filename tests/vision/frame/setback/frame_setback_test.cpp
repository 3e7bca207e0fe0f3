#include "vision/frame/setback/frame_setback.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fenestra {
namespace {

TEST(FrameSetback, OneExactSightOfTheFrontTellsIt) {
  const SetbackPosterior posterior = InferSetback({{0.08, 0.001, false}}, 0.5);
  // Densities over 40 cm of sights and 20 cm of setbacks: of something else 0.05/0.4 whatever the
  // setback is, of the front 0.95/0.2 in all.
  const double other = 0.05 / 0.4;
  const double front = 0.95 / 0.2;
  const double sum = 2.0 * other + front;
  EXPECT_NEAR(posterior.flush, other / sum, 1e-3);
  EXPECT_NEAR(posterior.setback.mean_m, (front * 0.08 + other * 0.1) / sum, 1e-4);
}

TEST(FrameSetback, WithoutSightsItIsWhatItWasBefore) {
  const SetbackPosterior posterior = InferSetback({}, 0.3);
  EXPECT_NEAR(posterior.flush, 0.3, 1e-12);
  // Evenly from 0 to 20 cm with the rest: means of s and s².
  EXPECT_NEAR(posterior.setback.mean_m, 0.7 * 0.1, 1e-9);
  EXPECT_NEAR(posterior.root_mean_square_m, std::sqrt(0.7 * 0.04 / 3.0), 1e-5);
}

TEST(FrameSetback, AnEdgeOfTheThicknessIsBehindTheFront) {
  const SetbackPosterior front = InferSetback({{0.10, 0.002, false}}, 0.0);
  const SetbackPosterior thickness = InferSetback({{0.10, 0.002, true}}, 0.0);
  // In the mean half of 12 cm; what is of something else shares in both.
  EXPECT_NEAR(front.setback.mean_m - thickness.setback.mean_m, 0.06, 0.005);
  EXPECT_GT(thickness.setback.sigma_m, front.setback.sigma_m);
  // Both edges of it share one thickness: two sights of it are no two opinions of it.
  const SetbackPosterior twice = InferSetback({{0.10, 0.002, true}, {0.10, 0.002, true}}, 0.0);
  EXPECT_GT(twice.setback.sigma_m, 1.02 * thickness.setback.sigma_m / std::sqrt(2.0));
}

TEST(FrameSetback, EdgesInThePlaneAreAFlushFrames) {
  const std::vector<DepthMeasurement> in_plane = {{0.001, 0.003, false}, {-0.002, 0.003, false}};
  EXPECT_GT(InferSetback(in_plane, 0.5).flush, 0.95);
  // The twin: it is known not to be flush.
  EXPECT_EQ(InferSetback(in_plane, 0.0).flush, 0.0);
}

}  // namespace
}  // namespace fenestra
