#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "renderers/ray_caster.h"
#include "scenes/facade.h"
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

}  // namespace
}  // namespace fenestra
