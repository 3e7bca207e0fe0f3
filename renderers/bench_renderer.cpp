// How fast the renderer is, beside the bare ray tracing loop with the same rays. Items are rays.
//   bench_renderer --benchmark_min_time=1

#include <benchmark/benchmark.h>

#include "renderers/lane_kernels.h"
#include "renderers/net_samples.h"
#include "renderers/ray_caster.h"
#include "renderers/traced_scene.h"
#include "scenes/facade.h"
#include "scenes/paper_target.h"

namespace fenestra {
namespace {

// The stereo camera: 752 x 480 px, 4 mm lens, 6 µm pixels, barrel distortion.
CameraModel StereoCamera() {
  return CameraModel({.width_px = 752,
                      .height_px = 480,
                      .fx_px = 4e-3 / 6e-6,
                      .fy_px = 4e-3 / 6e-6,
                      .cx_px = 375.5,
                      .cy_px = 239.5,
                      .distortion = {.k1 = -0.10, .k2 = 0.01, .p1 = 1e-4, .p2 = -1e-4}});
}

// 2 m in front of the window and a little to its side, looking straight at the wall.
Pose InFront() {
  Eigen::Matrix3d R_WC = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return Pose(R_WC, Eigen::Vector3d(0.3, 0.2, 2.0));
}

Lighting Daylight() {
  Lighting lighting;
  lighting.sun = {.azimuth_rad = 0.6, .elevation_rad = 0.7, .illuminance_lx = 6e4};
  lighting.sky.illuminance_lx = 1e4;
  return lighting;
}

enum SceneName : int { kPaperTarget, kFacade };

Scene MakeScene(int64_t name) {
  return name == kPaperTarget ? MakePaperTarget({}) : MakeFacade({.window = {.setback_m = 0.1}});
}

constexpr int kSamples = 4;

// The packets of a render with 4 samples per pixel: 2 x 2 pixels each, scrambling left out.
std::vector<RayPacket> MakePackets() {
  const RayGrid rays(StereoCamera());
  const FloatPose camera = ToFloat(InFront());
  std::vector<RayPacket> packets;
  for (int row = 0; row + 1 < rays.height_px(); row += 2) {
    for (int column = 0; column + 1 < rays.width_px(); column += 2) {
      Lanes<float> x;
      Lanes<float> y;
      for (int i = 0; i < kLanes; ++i) {
        const Eigen::Vector2f& a = rays.Corner(column + i / 4 % 2, row + i / 8);
        const Eigen::Vector2f& b = rays.Corner(column + i / 4 % 2 + 1, row + i / 8 + 1);
        const auto sample = static_cast<size_t>(i % kSamples);
        x[i] = a.x() + (b.x() - a.x()) * ToUnit(ReverseBits(kNetTable.x[sample]));
        y[i] = a.y() + (b.y() - a.y()) * ToUnit(ReverseBits(kNetTable.y[sample]));
      }
      RayPacket& packet = packets.emplace_back();
      SetRays(packet, camera.p_WC, ToWorld(camera.axes, x, y));
    }
  }
  return packets;
}

// Embree's rtcIntersect16 and nothing else, on rays made before.
void BM_BareIntersect16(benchmark::State& state) {
  const TracedScene traced(MakeScene(state.range(0)));
  const std::vector<RayPacket> packets = MakePackets();
  const LaneMask all = FirstLanes(kLanes);
  for (auto _ : state) {
    for (const RayPacket& packet : packets) {
      RayPacket traced_packet = packet;
      traced.opaque_tracer().Intersect(all, traced_packet, Coherence::kCoherent);
      benchmark::DoNotOptimize(traced_packet);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(packets.size()) * kLanes);
}

void RenderLoop(benchmark::State& state, const Lighting& lighting, const RenderOptions& options) {
  const RayCaster caster(MakeScene(state.range(0)));
  const RayGrid rays(StereoCamera());
  for (auto _ : state) {
    benchmark::DoNotOptimize(caster.Render(rays, InFront(), lighting, options, RandomStream(1)));
  }
  // Base samples; what an adaptive render adds at edges is not counted.
  state.SetItemsProcessed(state.iterations() * rays.width_px() * rays.height_px() *
                          options.samples_per_pixel);
}

// A render without a sun: one ray per sample, and its shading.
void BM_PrimaryVisibility(benchmark::State& state) {
  Lighting lighting = Daylight();
  lighting.sun.illuminance_lx = 0.0;
  RenderLoop(state, lighting, {.edge_samples_per_pixel = kSamples});
}

// One image of the pair, with sun shadows (so up to two rays per sample).
void BM_RenderStereoImage(benchmark::State& state) {
  RenderLoop(state, Daylight(), {.edge_samples_per_pixel = kSamples});
}

void BM_RenderAdaptive(benchmark::State& state) {
  RenderLoop(state, Daylight(), {});
}

void BM_CastAovs(benchmark::State& state) {
  const RayCaster caster(MakeScene(state.range(0)));
  const RayGrid rays(StereoCamera());
  AovOptions options;
  options.p_WP = Eigen::Vector3d(0.375, 0.2, 2.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(caster.CastAovs(rays, InFront(), Daylight(), options));
  }
  state.SetItemsProcessed(state.iterations() * rays.width_px() * rays.height_px());
}

void BM_MakeRayGrid(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(RayGrid(StereoCamera()));
}

void BM_MakeRayCaster(benchmark::State& state) {
  const Scene scene = MakeScene(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(RayCaster(scene));
}

void BothScenes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("facade")->Arg(kPaperTarget)->Arg(kFacade)->Unit(benchmark::kMillisecond);
}

BENCHMARK(BM_BareIntersect16)->Apply(BothScenes);
BENCHMARK(BM_PrimaryVisibility)->Apply(BothScenes);
BENCHMARK(BM_RenderStereoImage)->Apply(BothScenes);
BENCHMARK(BM_RenderAdaptive)->Apply(BothScenes);
BENCHMARK(BM_CastAovs)->Apply(BothScenes);
BENCHMARK(BM_MakeRayGrid)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_MakeRayCaster)->Apply(BothScenes);

}  // namespace
}  // namespace fenestra

BENCHMARK_MAIN();
