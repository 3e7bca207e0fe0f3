// How long a sensor takes from light to grey values, without rendering.
//   bench_sensor --benchmark_min_time=1

#include <benchmark/benchmark.h>

#include "scenes/facade.h"
#include "sim/image_sensor.h"
#include "sim/lens.h"
#include "sim/stereo_rig.h"
#include "sim/structured_light_sensor.h"
#include "sim/viewpoint.h"

namespace fenestra {
namespace {

constexpr int kWidth = 752;
constexpr int kHeight = 480;

QuarterImages SomeLight() {
  QuarterImages quarters;
  for (size_t q = 0; q < quarters.size(); ++q) {
    quarters[q] = cv::Mat1f(kHeight, kWidth);
    RandomStream(1).Child("light", q).FillUniforms({quarters[q].ptr<float>(), quarters[q].total()});
    quarters[q] = 1e6 * (1.0 + quarters[q]);
  }
  return quarters;
}

void BM_Gather(benchmark::State& state) {
  const QuarterImages light = SomeLight();
  const LensOptions lens;
  for (auto _ : state) {
    benchmark::DoNotOptimize(Gather(light, {.centre_sigma_px = lens.blur_sigma_px,
                                            .corner_sigma_px = lens.corner_blur_sigma_px}));
  }
}
BENCHMARK(BM_Gather)->Unit(benchmark::kMillisecond);

void BM_Expose(benchmark::State& state) {
  const cv::Mat1f light = SomeLight()[0];
  const ImageSensor sensor({}, light.size(), RandomStream(2));
  uint64_t frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(sensor.Expose(light, {.exposure_s = 5e-3, .gain = 1.0},
                                           RandomStream(3).Child("frame", frame++)));
  }
}
BENCHMARK(BM_Expose)->Unit(benchmark::kMillisecond);

// The random numbers that an exposure cannot do without.
void BM_Normals(benchmark::State& state) {
  cv::Mat1f normals(kHeight, kWidth);
  uint64_t frame = 0;
  for (auto _ : state) {
    RandomStream(3).Child("frame", frame++).FillNormals({normals.ptr<float>(), normals.total()});
    benchmark::DoNotOptimize(normals.data);
  }
}
BENCHMARK(BM_Normals)->Unit(benchmark::kMillisecond);

// Both images of the pair, from radiance to eight bits.
void BM_StereoPair(benchmark::State& state) {
  const QuarterImages light = SomeLight();
  const StereoRig rig({}, RandomStream(4));
  uint64_t frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(rig.Develop(light, light, RandomStream(3).Child("frame", frame++)));
  }
}
BENCHMARK(BM_StereoPair)->Unit(benchmark::kMillisecond);

void BM_RigConstruction(benchmark::State& state) {
  uint64_t index = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(StereoRig({}, RandomStream(4).Child("rig", index++)));
  }
}
BENCHMARK(BM_RigConstruction)->Unit(benchmark::kMillisecond);

// A depth and a colour frame of a facade with one window, 2 m away. Argument: the depth model.
void BM_RgbdFrame(benchmark::State& state) {
  StructuredLightOptions options;
  options.depth_model = static_cast<DepthModel>(state.range(0));
  const StructuredLightSensor sensor(options);
  const RayCaster caster(MakeFacade({}));
  Lighting lighting;
  lighting.sky.illuminance_lx = 1000.0;
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  uint64_t frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        sensor.Observe(caster, lighting, X_WB, RandomStream(3).Child("frame", frame++)));
  }
}
BENCHMARK(BM_RgbdFrame)->ArgName("model")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

// The depth frame alone.
void BM_DepthFrame(benchmark::State& state) {
  StructuredLightOptions options;
  options.depth_model = static_cast<DepthModel>(state.range(0));
  const StructuredLightSensor sensor(options);
  const RayCaster caster(MakeFacade({}));
  Lighting lighting;
  lighting.sky.illuminance_lx = 1000.0;
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  uint64_t frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        sensor.ObserveDepth(caster, lighting, X_WB, RandomStream(3).Child("frame", frame++)));
  }
}
BENCHMARK(BM_DepthFrame)->ArgName("model")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fenestra

BENCHMARK_MAIN();
