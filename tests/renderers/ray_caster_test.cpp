#include "renderers/ray_caster.h"

#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "core/io/input_error.h"
#include "scenes/facade/facade.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

Lighting Daylight() {
  Lighting lighting = OnlySun(0.4, 0.6, 5e4);
  lighting.sky.illuminance_lx = 1e4;
  return lighting;
}

cv::Mat Render(const RayCaster& caster, uint64_t seed) {
  const RayGrid rays(DistortedCamera());
  const Pose X_WC = LookingAt({0.7, 0.3, 1.5}, {0.0, 0.0, 0.0});
  return caster.Render(rays, X_WC, Daylight(), {}, RandomStream(seed));
}

bool SameBits(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

const RayCaster& Facade() {
  static const RayCaster caster(MakeFacade({.window = {.setback_m = 0.1}}));
  return caster;
}

TEST(RayCaster, TwoThreadsAtOnceAndOneAfterTheOtherRenderTheSameBits) {
  const cv::Mat alone = Render(Facade(), 1);
  cv::Mat first;
  cv::Mat second;
  std::thread thread([&] { first = Render(Facade(), 1); });
  second = Render(Facade(), 1);
  thread.join();
  EXPECT_TRUE(SameBits(alone, first));
  EXPECT_TRUE(SameBits(alone, second));
}

TEST(RayCaster, BuiltTwiceRendersTheSameBits) {
  const RayCaster other(MakeFacade({.window = {.setback_m = 0.1}}));
  EXPECT_TRUE(SameBits(Render(Facade(), 1), Render(other, 1)));
  EXPECT_FALSE(SameBits(Render(Facade(), 1), Render(other, 2)));
}

// The policy of docs/performance.md: instruction sets may differ in last bits of hits, no more.
// Where an edge is decided by such a bit, a pixel's search may end one step of 1/256 further; where
// the fineness of light is, light differs within what interpolation may err.
TEST(RayCaster, InstructionSetsDifferByRoundingAndWhatItDecides) {
  const Scene scene = MakeFacade({.window = {.setback_m = 0.1}});
  const cv::Mat1f best = Render(Facade(), 1);
  double brightest = 0.0;
  cv::minMaxLoc(best, nullptr, &brightest);
  for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kSse42}) {
    const cv::Mat1f other = Render(RayCaster(scene, {.instruction_set = set}), 1);
    const cv::Mat1f difference = cv::abs(other - best);
    double largest = 0.0;
    cv::minMaxLoc(difference, nullptr, &largest);
    const int decided = cv::countNonZero(difference > 1e-3 * brightest);
    RecordProperty("largest_difference_of_1", std::to_string(largest / brightest));
    RecordProperty("pixels_beyond_1e-3", decided);
    EXPECT_LT(largest, 0.02 * brightest);
    EXPECT_LT(decided, static_cast<int>(best.total()) / 200);
  }
}

TEST(RenderOptions, AllFaultsAreReportedAtOnce) {
  try {
    Validate(RenderOptions{.samples_per_pixel = 7, .edge_samples_per_pixel = 5});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3u) << error.what();
  }
}

TEST(RayCasterOptions, BouncesOutOfRangeAreRefused) {
  EXPECT_THROW(RayCaster(MakeFacade({}), {.bounces = -1}), InputError);
  EXPECT_THROW(RayCaster(MakeFacade({}), {.bounces = 1001}), InputError);
}

}  // namespace
}  // namespace fenestra
