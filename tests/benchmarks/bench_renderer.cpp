// How fast the renderer is, beside the bare ray tracing loop with the same rays. Items are rays.
//   bench_renderer --benchmark_min_time=1

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "renderers/light/lane_kernels.h"
#include "renderers/light/light_transport.h"
#include "renderers/ray_caster.h"
#include "renderers/tracing/pane_kernels.h"
#include "renderers/tracing/sobol_samples.h"
#include "renderers/tracing/traced_scene.h"
#include "scenes/facade/facade.h"
#include "scenes/targets/flat_targets.h"

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

// The painted target; one window with glass; nine of them in a brick wall with sills.
enum SceneName : int { kPaperTarget, kFacade, kStreet };

Scene MakeScene(int64_t name) {
  if (name == kPaperTarget) return MakePaperTarget({});
  FacadeOptions options{.window = {.setback_m = 0.1}};
  if (name == kStreet) {
    options.wall.finish = WallFinish::kBrick;
    options.wall.paint.reflectance = 0.3;
    options.wall.paint.reflectance_830nm = 0.4;
    options.wall.texture_contrast = 0.2;
    options.grid = {.windows_left = 1, .windows_right = 1, .windows_above = 1, .windows_below = 1};
    options.sill.present = true;
  }
  return MakeFacade(options);
}

constexpr int kSamples = 4;

// The packets of a render with 4 samples per pixel: blocks of 4 x 4 pixels, scrambling left out.
std::vector<RayPacket> MakePackets() {
  const RayGrid rays(StereoCamera());
  const FloatPose camera = ToFloat(InFront());
  const auto stride = static_cast<uint32_t>(rays.width_px() + 1);
  std::vector<RayPacket> packets;
  for (int row = 0; row < rays.height_px(); row += 4) {
    for (int column = 0; column < rays.width_px(); column += 4) {
      Lanes<uint32_t> corner;
      for (int i = 0; i < kLanes; ++i) {
        corner[i] =
            static_cast<uint32_t>(row + i / 4) * stride + static_cast<uint32_t>(column + i % 4);
      }
      const PixelPatches patches = PatchesOf(rays.corner_data(), corner, stride);
      for (size_t sample = 0; sample < kSamples; ++sample) {
        PixelPoints points;
        points.s.v.fill(ToUnit(ReverseBits(kSobolTable.x[sample])));
        points.t.v.fill(ToUnit(ReverseBits(kSobolTable.y[sample])));
        const ImagePoints image = InPixels(patches, points);
        RayPacket& packet = packets.emplace_back();
        SetRays(packet, camera.p_WC, ToWorld(camera.axes, image.x, image.y));
      }
    }
  }
  return packets;
}

// All rays that a render with sun and panes traces, as packets: what the camera sees, what it sees
// past panes and mirrored in them, and the way to the sun from where those end. What only checks
// for panes on the way to the sun is left out.
struct AllRays {
  struct Traced {
    LaneMask mask;
    RayPacket packet;
  };
  std::vector<Traced> seen;      // In the tracer of all surfaces.
  std::vector<Traced> mirrored;  // In the opaque one,
  std::vector<Traced> sunward;   // and so these, which ask for any hit.
};

AllRays RecordRays(const TracedScene& traced, const glm::vec3& to_sun_W) {
  AllRays rays;
  const float offset_m = traced.SurfaceOffset(ToFloat(InFront()).p_WC);
  const auto add_sunward = [&](LaneMask mask, const RayPacket& ends) {
    bool any = false;
    for (int i = 0; i < kLanes; ++i) {
      const glm::vec3 n(ends.hit.Ng_x[i], ends.hit.Ng_y[i], ends.hit.Ng_z[i]);
      const glm::vec3 d(ends.ray.dir_x[i], ends.ray.dir_y[i], ends.ray.dir_z[i]);
      const bool faces = glm::dot(n, to_sun_W) * glm::dot(n, d) < 0.0f;
      if (ends.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID || !faces) mask[i] = 0;
      any = any || mask[i] != 0;
    }
    if (!any) return;
    RayPacket sunward;
    sunward.ray = RaysFromHits(ends, offset_m, to_sun_W);
    rays.sunward.push_back({mask, sunward});
  };
  for (const RayPacket& fresh : MakePackets()) {
    rays.seen.push_back({FirstLanes(kLanes), fresh});
    RayPacket packet = fresh;
    traced.IntersectThroughPanes(FirstLanes(kLanes), packet, Coherence::kCoherent,
                                 [&](const LaneMask& panes, const RayPacket& at_panes) {
                                   RayPacket mirror = MirroredRays(panes, at_panes, offset_m);
                                   rays.mirrored.push_back({panes, mirror});
                                   traced.opaque_tracer().Intersect(panes, mirror,
                                                                    Coherence::kCoherent);
                                   add_sunward(panes, mirror);
                                   RayPacket beyond = at_panes;
                                   SearchBeyond(panes, beyond);
                                   rays.seen.push_back({panes, beyond});
                                 });
    add_sunward(FirstLanes(kLanes), packet);
  }
  return rays;
}

// Embree's rtcIntersect16 and nothing else, on the camera's rays, made before.
void BM_BareIntersect16(benchmark::State& state) {
  const TracedScene traced(MakeScene(state.range(0)));
  const std::vector<RayPacket> packets = MakePackets();
  const LaneMask all = FirstLanes(kLanes);
  for (auto _ : state) {
    for (const RayPacket& packet : packets) {
      RayPacket traced_packet = packet;
      traced.all_tracer().Intersect(all, traced_packet, Coherence::kCoherent);
      benchmark::DoNotOptimize(traced_packet);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(packets.size()) * kLanes);
}

// The renderer's own first stage on the same rays: making and scrambling them, finding what they
// hit, and which side of which surface that is.
void BM_PrimaryVisibility(benchmark::State& state) {
  const TracedScene traced(MakeScene(state.range(0)));
  const std::vector<uint32_t> keys = MakeSideKeys(NumberSurfaces(traced.opaque()));
  const RayGrid rays(StereoCamera());
  const FloatPose camera = ToFloat(InFront());
  const auto stride = static_cast<uint32_t>(rays.width_px() + 1);
  const auto triangles = static_cast<uint32_t>(traced.opaque().size());
  const LaneMask all = FirstLanes(kLanes);
  const ImageScramble scramble(1);
  for (auto _ : state) {
    for (int row = 0; row < rays.height_px(); row += 4) {
      for (int column = 0; column < rays.width_px(); column += 4) {
        const auto index = static_cast<uint32_t>(row * rays.width_px() + column);
        const PixelBlock block =
            MakePixelBlock(static_cast<uint32_t>(row) * stride + static_cast<uint32_t>(column),
                           stride, index, static_cast<uint32_t>(rays.width_px()), scramble);
        const PixelPatches patches = PatchesOf(rays.corner_data(), block.corner, stride);
        for (size_t sample = 0; sample < kSamples; ++sample) {
          const ImagePoints image =
              InPixels(patches, ScrambledPoints(AllLanes(kSobolTable.x[sample]),
                                                AllLanes(kSobolTable.y[sample]), block.seed_x,
                                                block.seed_y));
          RayPacket packet;
          SetRays(packet, camera.p_WC, ToWorld(camera.axes, image.x, image.y));
          traced.all_tracer().Intersect(all, packet, Coherence::kCoherent);
          Lanes<uint32_t> sides = SidesHit(packet, triangles);
          // A pane's index is not one of an opaque triangle.
          for (int i = 0; i < kLanes; ++i) sides[i] = std::min(sides[i], 2 * triangles + 1);
          Lanes<uint32_t> seen = LookUp(keys.data(), sides);
          benchmark::DoNotOptimize(seen);
        }
      }
    }
  }
  state.SetItemsProcessed(state.iterations() * rays.width_px() * rays.height_px() * kSamples);
}

// Bare Embree on all rays of one image of the pair, the sun's included.
void BM_BareStereoImage(benchmark::State& state) {
  const TracedScene traced(MakeScene(state.range(0)));
  const Eigen::Vector3f to_sun = Daylight().sun.Direction_W().cast<float>();
  const AllRays rays = RecordRays(traced, {to_sun.x(), to_sun.y(), to_sun.z()});
  for (auto _ : state) {
    for (const AllRays::Traced& ray : rays.seen) {
      RayPacket packet = ray.packet;
      traced.all_tracer().Intersect(ray.mask, packet, Coherence::kCoherent);
      benchmark::DoNotOptimize(packet);
    }
    for (const AllRays::Traced& ray : rays.mirrored) {
      RayPacket packet = ray.packet;
      traced.opaque_tracer().Intersect(ray.mask, packet, Coherence::kCoherent);
      benchmark::DoNotOptimize(packet);
    }
    for (const AllRays::Traced& ray : rays.sunward) {
      RTCRay16 sunward = ray.packet.ray;
      traced.opaque_tracer().Occlude(ray.mask, sunward, Coherence::kCoherent);
      benchmark::DoNotOptimize(sunward);
    }
  }
  state.SetItemsProcessed(
      state.iterations() * kLanes *
      static_cast<int64_t>(rays.seen.size() + rays.mirrored.size() + rays.sunward.size()));
}

void RenderLoop(benchmark::State& state, const Lighting& lighting, const RenderOptions& options) {
  const RayCaster caster(MakeScene(state.range(0)));
  const RayGrid rays(StereoCamera());
  caster.Render(RayGrid(CameraModel::Pinhole(16, 16, 20.0)), InFront(), lighting, {},
                RandomStream(1));  // The diffuse light is found once per lighting.
  for (auto _ : state) {
    benchmark::DoNotOptimize(caster.Render(rays, InFront(), lighting, options, RandomStream(1)));
  }
  // Base samples; what an adaptive render adds at edges is not counted.
  state.SetItemsProcessed(state.iterations() * rays.width_px() * rays.height_px() *
                          options.samples_per_pixel);
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

// A wall of at least so many triangles, in squares.
Mesh FineWall(size_t triangles) {
  const auto side =
      static_cast<uint32_t>(std::ceil(std::sqrt(0.5 * static_cast<double>(triangles))));
  constexpr float kSide_m = 12.0f;
  Mesh wall{.name = "wall", .material = 0};
  for (uint32_t row = 0; row <= side; ++row) {
    for (uint32_t column = 0; column <= side; ++column) {
      const auto at = [&](uint32_t i) {
        return kSide_m * (static_cast<float>(i) / static_cast<float>(side) - 0.5f);
      };
      wall.positions_W.emplace_back(at(column), at(row), 0.0f);
      if (row == side || column == side) continue;
      const uint32_t corner = row * (side + 1) + column;
      wall.triangles.push_back(glm::uvec3(corner, corner + 1, corner + side + 2));
      wall.triangles.push_back(glm::uvec3(corner, corner + side + 2, corner + side + 1));
    }
  }
  return wall;
}

// Under sun and sky, 4 samples a pixel.
void BM_RenderTriangles(benchmark::State& state) {
  Scene scene = MakePaperTarget({.with_target = false});
  scene.meshes = {FineWall(static_cast<size_t>(state.range(0)))};
  const RayCaster caster(scene);
  const RayGrid rays(StereoCamera());
  caster.Render(RayGrid(CameraModel::Pinhole(16, 16, 20.0)), InFront(), Daylight(), {},
                RandomStream(1));
  for (auto _ : state) {
    benchmark::DoNotOptimize(caster.Render(rays, InFront(), Daylight(),
                                           {.edge_samples_per_pixel = kSamples}, RandomStream(1)));
  }
  state.counters["triangles"] = static_cast<double>(scene.meshes[0].triangles.size());
}

void BM_RenderSamples(benchmark::State& state) {
  const int samples = static_cast<int>(state.range(1));
  RenderLoop(state, Daylight(), {.samples_per_pixel = samples, .edge_samples_per_pixel = samples});
}

// Another illuminance of known lights, and another position of the sun.
void BM_NewLighting(benchmark::State& state) {
  const RayCaster caster(MakeScene(state.range(0)));
  const RayGrid rays(CameraModel::Pinhole(16, 16, 20.0));
  Lighting lighting = Daylight();
  for (auto _ : state) {
    lighting.sun.illuminance_lx *= 0.999;
    if (state.range(1) != 0) lighting.sun.azimuth_rad += 1e-4;
    benchmark::DoNotOptimize(caster.Render(rays, InFront(), lighting, {}, RandomStream(1)));
  }
}

void BM_MakeRayGrid(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(RayGrid(StereoCamera()));
}

void BM_MakeRayCaster(benchmark::State& state) {
  const Scene scene = MakeScene(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(RayCaster(scene));
}

void AllScenes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("scene")->DenseRange(kPaperTarget, kStreet)->Unit(benchmark::kMillisecond);
}

BENCHMARK(BM_BareIntersect16)->Apply(AllScenes);
BENCHMARK(BM_PrimaryVisibility)->Apply(AllScenes);
BENCHMARK(BM_BareStereoImage)->Apply(AllScenes);
BENCHMARK(BM_RenderStereoImage)->Apply(AllScenes);
BENCHMARK(BM_RenderAdaptive)->Apply(AllScenes);
BENCHMARK(BM_CastAovs)->Apply(AllScenes);
BENCHMARK(BM_RenderTriangles)
    ->RangeMultiplier(10)
    ->Range(100, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_RenderSamples)
    ->ArgsProduct({{kFacade}, {1, 4, 16, 64, 256}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_MakeRayGrid)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_MakeRayCaster)->Apply(AllScenes);
BENCHMARK(BM_NewLighting)->ArgsProduct({{kFacade, kStreet}, {0, 1}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fenestra

BENCHMARK_MAIN();
