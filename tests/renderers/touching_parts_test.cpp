#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "renderers/ray_caster.h"
#include "renderers/tracing/traced_scene.h"
#include "scenes/mesh/solid_bodies.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

constexpr double kSky_lx = 1e4;

void AddPart(const Box& box, Scene& scene) {
  Mesh mesh{.name = "part", .material = 0};
  AddCuboid(CuboidOf(box), 1, mesh);
  scene.meshes.push_back(std::move(mesh));
}

// A house front as modellers make it: no two parts share a corner. Door posts and the window's bars
// go through the wall's face, a lintel lies on it, a sign hangs 1 mm before it.
Scene HouseOfTouchingParts() {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  AddPart({{-2.0, -1.5, -0.2}, {2.0, 1.5, 0.0}}, scene);
  AddPart({{0.4, -1.5, -0.1}, {0.5, 0.4, 0.05}}, scene);
  AddPart({{1.2, -1.5, -0.1}, {1.3, 0.4, 0.05}}, scene);
  AddPart({{0.3, 0.6, 0.0}, {1.4, 0.7, 0.08}}, scene);
  AddPart({{-1.20, -0.50, -0.05}, {-1.14, 0.50, 0.03}}, scene);
  AddPart({{-0.46, -0.50, -0.05}, {-0.40, 0.50, 0.03}}, scene);
  AddPart({{-1.25, -0.56, -0.05}, {-0.35, -0.50, 0.06}}, scene);
  AddPart({{-1.25, 0.50, -0.05}, {-0.35, 0.56, 0.03}}, scene);
  scene.meshes.push_back(UprightRectangle(-1.8f, -1.0f, -1.4f, 1.0f, 0.001f, 0));
  return scene;
}

// Directions about n of equal cosine-weighted solid angle, on a spiral: no direction of the bake is
// among them.
std::vector<glm::vec3> CosineSpiral(const glm::vec3& n, int count) {
  const glm::vec3 helper = std::abs(n.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
  const glm::vec3 t = glm::normalize(glm::cross(helper, n));
  const glm::vec3 b = glm::cross(n, t);
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<glm::vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double rr = (i + 0.5) / count;
    const auto x = static_cast<float>(std::sqrt(rr) * std::cos(golden * i));
    const auto y = static_cast<float>(std::sqrt(rr) * std::sin(golden * i));
    directions.push_back(x * t + y * b + static_cast<float>(std::sqrt(1.0 - rr)) * n);
  }
  return directions;
}

// The illuminance by a uniform sky, by 1024 rays of its own.
double SkyAt(const TracedScene& traced, const glm::vec3& p_W, const glm::vec3& n_W) {
  constexpr int kRays = 1024;
  const std::vector<glm::vec3> directions = CosineSpiral(n_W, kRays);
  int open = 0;
  for (int first = 0; first < kRays; first += kLanes) {
    Directions soa;
    LaneMask mask;
    for (int i = 0; i < kLanes; ++i) {
      const glm::vec3& d = directions[static_cast<size_t>(first + i)];
      soa.x[i] = d.x;
      soa.y[i] = d.y;
      soa.z[i] = d.z;
      mask[i] = d.y > 0.0f ? -1 : 0;
    }
    RayPacket packet;
    SetRays(packet, p_W + 1e-4f * n_W, soa);
    traced.opaque_tracer().Occlude(mask, packet.ray, Coherence::kIncoherent);
    for (int i = 0; i < kLanes; ++i) open += mask[i] != 0 && packet.ray.tfar[i] > 0.0f ? 1 : 0;
  }
  return kSky_lx * open / kRays;
}

struct SeenPoint {
  int object = -1;
  glm::vec3 p_W{0.0f};
  glm::vec3 n_W{0.0f};
  double rendered_lx = 0.0;
  double true_lx = 0.0;
};

constexpr int kWidth_px = 240;
constexpr int kHeight_px = 180;

// What a camera sees of the scene under the sky alone, in the order of the pixels; without an
// object where nothing is seen.
std::vector<SeenPoint> LookAt(const Scene& scene) {
  const TracedScene traced(scene);
  const RayCaster caster(scene, {.bounces = 0});
  const CameraModel camera = CameraModel::Pinhole(kWidth_px, kHeight_px, 195.0);
  const Pose X_WC = LookingAt({0.6, 0.2, 3.2}, {0.0, 0.0, 0.0});
  const AovImages aovs = caster.CastAovs(RayGrid(camera), X_WC, OnlySky(kSky_lx, 0.0), {});
  const auto to_glm = [](const Eigen::Vector3d& v) {
    const Eigen::Vector3f f = v.cast<float>();
    return glm::vec3(f.x(), f.y(), f.z());
  };
  std::vector<SeenPoint> seen;
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      SeenPoint& point = seen.emplace_back();
      if (aovs.object_id(v, u) < 0) continue;
      const cv::Vec3d n = aovs.normal_C(v, u);
      const Eigen::Vector3d p_C =
          static_cast<double>(aovs.depth_m(v, u)) * *camera.UnprojectRay(Eigen::Vector2d(u, v));
      point = {.object = aovs.object_id(v, u),
               .p_W = to_glm(X_WC * p_C),
               .n_W = to_glm(X_WC.rotation() * Eigen::Vector3d(n[0], n[1], n[2])),
               .rendered_lx = static_cast<double>(aovs.irradiance_lx(v, u))};
      point.true_lx = SkyAt(traced, point.p_W, point.n_W);
    }
  }
  return seen;
}

// How much darker than everything that can be seen of its face within a cell is in truth: light
// that is interpolated between visible points cannot be darker than all of them.
struct Darkness {
  double part = 0.0;  // Of the light of the open sky.
  glm::vec3 p_W{0.0f};
};

Darkness WorstDarkness(const std::vector<SeenPoint>& seen) {
  constexpr int kReach_px = 8;  // Of a cell in the picture.
  Darkness worst;
  for (int v = kReach_px; v < kHeight_px - kReach_px; ++v) {
    for (int u = kReach_px; u < kWidth_px - kReach_px; ++u) {
      const SeenPoint& here = seen[static_cast<size_t>(v * kWidth_px + u)];
      if (here.object < 0) continue;
      double darkest_lx = here.true_lx;
      for (int dv = -kReach_px; dv <= kReach_px; ++dv) {
        for (int du = -kReach_px; du <= kReach_px; ++du) {
          const SeenPoint& there = seen[static_cast<size_t>((v + dv) * kWidth_px + u + du)];
          if (there.object != here.object || glm::dot(there.n_W, here.n_W) < 0.99f) continue;
          darkest_lx = std::min(darkest_lx, there.true_lx);
        }
      }
      const double part = (darkest_lx - here.rendered_lx) / (0.5 * kSky_lx);
      if (part > worst.part) worst = {part, here.p_W};
    }
  }
  return worst;
}

// At the foot of a part light falls to about a half, within the 5 to 8 cm by which it stands out;
// linear interpolation over a cell of 13 cm spreads that, and the last pixel does not see the foot
// itself. The light of hidden points is missing altogether.
constexpr double kMostDarkness = 0.25;

TEST(TouchingParts, DarkenNothingThatCanBeSeen) {
  const Darkness worst = WorstDarkness(LookAt(HouseOfTouchingParts()));
  EXPECT_LT(worst.part, kMostDarkness)
      << "at (" << worst.p_W.x << ", " << worst.p_W.y << ", " << worst.p_W.z << ")";
}

// Parts that are turned inside out bound no bodies, so that what lies in them counts as visible.
TEST(TouchingParts, WouldBeSeenToDarkenTheWall) {
  Scene scene = HouseOfTouchingParts();
  for (Mesh& mesh : scene.meshes) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  }
  EXPECT_GT(WorstDarkness(LookAt(scene)).part, kMostDarkness);
}

}  // namespace
}  // namespace fenestra
