// How long a sensor takes from light to grey values, without rendering.
//   bench_sensor --benchmark_min_time=1

#include <benchmark/benchmark.h>

#include <vector>

#include "core/system/program.h"
#include "renderers/light/lane_kernels.h"
#include "renderers/tracing/pane_kernels.h"
#include "renderers/tracing/traced_scene.h"
#include "scenes/facade/facade.h"
#include "sim/camera/image_sensor.h"
#include "sim/camera/lens.h"
#include "sim/camera/point_spread.h"
#include "sim/motion/rig_pose.h"
#include "sim/stereo/stereo_rig.h"
#include "sim/structured_light/structured_light_sensor.h"

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
  uint64_t image = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(sensor.Expose(light, {.exposure_s = 5e-3, .gain = 1.0},
                                           RandomStream(3).Child("frame", image++)));
  }
}
BENCHMARK(BM_Expose)->Unit(benchmark::kMillisecond);

// The random numbers that an exposure cannot do without.
void BM_Normals(benchmark::State& state) {
  cv::Mat1f normals(kHeight, kWidth);
  uint64_t image = 0;
  for (auto _ : state) {
    RandomStream(3).Child("frame", image++).FillNormals({normals.ptr<float>(), normals.total()});
    benchmark::DoNotOptimize(normals.data);
  }
}
BENCHMARK(BM_Normals)->Unit(benchmark::kMillisecond);

// Both images of the pair, from radiance to eight bits.
void BM_StereoPair(benchmark::State& state) {
  const QuarterImages light = SomeLight();
  const StereoRig rig({}, RandomStream(4));
  uint64_t image = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(rig.Develop(light, light, RandomStream(3).Child("frame", image++)));
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

// A depth and a colour image of a facade with one window, 2 m away. Argument: the depth model.
void BM_RgbdFrame(benchmark::State& state) {
  StructuredLightOptions options;
  options.depth_model = static_cast<DepthModel>(state.range(0));
  const StructuredLightSensor sensor(options);
  const RayCaster caster(MakeFacade({}));
  Lighting lighting;
  lighting.sky.illuminance_lx = 1000.0;
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  uint64_t image = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        sensor.Observe(caster, lighting, X_WB, RandomStream(3).Child("frame", image++)));
  }
}
BENCHMARK(BM_RgbdFrame)->ArgName("model")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

struct FacadeView {
  RayCaster caster = RayCaster(MakeFacade({}));
  Lighting lighting;
  Pose X_WB = RigPose({.distance_m = 2.0}, Pose());

  FacadeView() { lighting.sky.illuminance_lx = 1000.0; }
};

// The light of the colour image alone. Arguments: samples per pixel, samples in pixels with edges
// (as many: edges are not searched), lines on which edges are searched.
void BM_ColorLight(benchmark::State& state) {
  const FacadeView view;
  const RayGrid rays(DesignOf(ColorCameraOptions{}));
  const RenderOptions options{
      .band = Band::kRgb,
      .samples_per_pixel = static_cast<int>(state.range(0)),
      .edge_samples_per_pixel = static_cast<int>(state.range(1)),
      .edge_lines = state.range(2) == 4 ? EdgeLines::kFour : EdgeLines::kSixteen};
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        view.caster.RenderQuarters(rays, view.X_WB, view.lighting, options, RandomStream(3)));
  }
}
BENCHMARK(BM_ColorLight)
    ->ArgNames({"samples", "edge", "lines"})
    ->Args({4, 4, 4})
    ->Args({4, 64, 16})
    ->Args({4, 64, 4})
    ->Args({1, 1, 4})
    ->Args({1, 64, 4})
    ->Unit(benchmark::kMillisecond);

// One ray through each pixel's centre, in blocks of 4 x 4.
std::vector<RayPacket> PacketsOf(const CameraModel& model, const Pose& X_WC) {
  const RayGrid rays(model);
  const FloatPose camera = ToFloat(X_WC);
  const auto stride = static_cast<uint32_t>(rays.width_px() + 1);
  PixelPoints centres;
  centres.s.v.fill(0.5f);
  centres.t.v.fill(0.5f);
  std::vector<RayPacket> packets;
  for (int row = 0; row < rays.height_px(); row += kBlockSide) {
    for (int column = 0; column < rays.width_px(); column += kBlockSide) {
      Lanes<uint32_t> corner;
      for (int i = 0; i < kLanes; ++i) {
        corner[i] = static_cast<uint32_t>(row + i / kBlockSide) * stride +
                    static_cast<uint32_t>(column + i % kBlockSide);
      }
      const ImagePoints image = InPixels(PatchesOf(rays.corner_data(), corner, stride), centres);
      SetRays(packets.emplace_back(), camera.p_WC, ToWorld(camera.axes, image.x, image.y));
    }
  }
  return packets;
}

// Embree alone on one ray for each pixel of a colour image and of a depth image, and on
// one from where the latter end to the projector. Argument: the depth camera's width.
void BM_BareRgbdRays(benchmark::State& state) {
  const FacadeView view;
  const TracedScene traced(MakeFacade({}));
  const StructuredLightOptions options;
  const int scale = static_cast<int>(state.range(0)) / options.depth_width_px;
  std::vector<RayPacket> packets = PacketsOf(DesignOf(options.color), view.X_WB);
  const std::vector<RayPacket> depth_packets = PacketsOf(
      CameraModel::Pinhole(scale * options.depth_width_px, scale * options.depth_height_px,
                           scale * options.depth_focal_px),
      view.X_WB);
  packets.insert(packets.end(), depth_packets.begin(), depth_packets.end());
  const LaneMask all = FirstLanes(kLanes);
  const Eigen::Vector3f p_WP =
      (view.X_WB * Eigen::Vector3d(options.projector_baseline_m, 0.0, 0.0)).cast<float>();
  std::vector<RTCRay16> to_projector;
  for (RayPacket packet : depth_packets) {
    traced.all_tracer().Intersect(all, packet, Coherence::kCoherent);
    RTCRay16& rays = to_projector.emplace_back(RaysFromHits(packet, 1e-4f, glm::vec3(0.0f)));
    for (int i = 0; i < kLanes; ++i) {
      rays.dir_x[i] = p_WP.x() - rays.org_x[i];
      rays.dir_y[i] = p_WP.y() - rays.org_y[i];
      rays.dir_z[i] = p_WP.z() - rays.org_z[i];
      rays.tfar[i] = 1.0f;
    }
  }
  for (auto _ : state) {
    for (const RayPacket& packet : packets) {
      RayPacket seen = packet;
      traced.all_tracer().Intersect(all, seen, Coherence::kCoherent);
      benchmark::DoNotOptimize(seen);
    }
    for (const RTCRay16& rays : to_projector) {
      RTCRay16 occluded = rays;
      traced.opaque_tracer().Occlude(all, occluded, Coherence::kCoherent);
      benchmark::DoNotOptimize(occluded);
    }
  }
  state.SetItemsProcessed(state.iterations() * kLanes *
                          static_cast<int64_t>(packets.size() + to_projector.size()));
}
BENCHMARK(BM_BareRgbdRays)->ArgName("width")->Arg(320)->Arg(640)->Unit(benchmark::kMillisecond);

// The depth image alone.
void BM_DepthImage(benchmark::State& state) {
  StructuredLightOptions options;
  options.depth_model = static_cast<DepthModel>(state.range(0));
  const StructuredLightSensor sensor(options);
  const RayCaster caster(MakeFacade({}));
  Lighting lighting;
  lighting.sky.illuminance_lx = 1000.0;
  const Pose X_WB = RigPose({.distance_m = 2.0}, Pose());
  uint64_t image = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        sensor.ObserveDepth(caster, lighting, X_WB, RandomStream(3).Child("frame", image++)));
  }
}
BENCHMARK(BM_DepthImage)->ArgName("model")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fenestra

int main(int argc, char** argv) {
  fenestra::KeepFreedMemory();  // As the program does.
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
