#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/random/random_stream.h"
#include "renderers/ray_caster.h"
#include "renderers/tracing/traced_scene.h"
#include "scenes/mesh/solid_lattice.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

Scene SolidBox(const Box& box) {
  std::array<std::vector<float>, 3> breaks;
  for (int axis = 0; axis < 3; ++axis) {
    breaks[static_cast<size_t>(axis)] =
        GradedBreaks({box.low[axis], box.high[axis]}, [](double) { return 0.7; });
  }
  SolidLattice lattice(breaks);
  lattice.Fill(box, 1);
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = {lattice.Surface(1, SolidLattice::Faces::kAll, "box", 0)};
  return scene;
}

struct Hit {
  double depth = std::numeric_limits<double>::infinity();
  Vector3d normal_W = Vector3d::Zero();
  double from_edge = 0.0;  ///< How far the ray passes the box's edges [m].
};

// Where a ray enters a box: the last of its entries into the three slabs.
Hit EnterBox(const Box& box, const Vector3d& origin, const Vector3d& direction) {
  Hit hit;
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.low[k] - origin[k]) / direction[k];
    const double b = (box.high[k] - origin[k]) / direction[k];
    if (std::min(a, b) > enter) {
      enter = std::min(a, b);
      axis = k;
    }
    leave = std::min(leave, std::max(a, b));
  }
  hit.from_edge = leave - enter;
  if (axis < 0 || !(enter < leave)) return hit;
  hit.depth = enter;
  hit.normal_W[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
  return hit;
}

TEST(Aovs, OfABoxAreThoseOfItsSlabsToSinglePrecision) {
  const Box box{{-0.5, -0.25, -0.75}, {0.5, 0.5, 0.25}};  // Exact in binary.
  const RayCaster caster(SolidBox(box));
  const RayGrid rays(DistortedCamera());
  for (const Vector3d& p_WC : {Vector3d(1.5, 1.0, 2.0), Vector3d(-1.0, -1.5, -1.7)}) {
    const Pose X_WC = LookingAt(p_WC, {0.1, 0.0, -0.2});
    const AovImages aovs = caster.CastAovs(rays, X_WC, Lighting{}, {});
    int hits = 0;
    for (int v = 0; v < rays.height_px(); ++v) {
      for (int u = 0; u < rays.width_px(); ++u) {
        const Vector3d ray_C = *rays.camera().UnprojectRay({u, v});
        const Hit hit = EnterBox(box, p_WC, X_WC.rotation() * ray_C);
        if (std::abs(hit.from_edge) < 1e-3) continue;  // Which face it is may be rounding.
        ASSERT_EQ(aovs.object_id(v, u) >= 0, std::isfinite(hit.depth)) << u << ", " << v;
        if (!std::isfinite(hit.depth)) continue;
        ++hits;
        // Rays are interpolated in single precision; on faces seen at a grazing angle its 1e-7 of
        // direction is some ten times as much in depth.
        EXPECT_NEAR(aovs.depth_m(v, u), hit.depth, 2e-6 * hit.depth);
        const cv::Vec3f n = aovs.normal_C(v, u);
        EXPECT_LT((X_WC.rotation() * Vector3d(n[0], n[1], n[2]) - hit.normal_W).norm(), 1e-6);
      }
    }
    EXPECT_GT(hits, 5000);
  }
}

// A ball of meridians and parallels, with the sphere's own normals.
Scene Ball(const Vector3d& centre, double radius, int parallels) {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  Mesh ball{.name = "ball", .closed = true};
  const int meridians = 2 * parallels;
  for (int i = 0; i <= parallels; ++i) {
    for (int j = 0; j <= meridians; ++j) {
      const double polar = std::numbers::pi * i / parallels;
      const double azimuth = 2.0 * std::numbers::pi * (j % meridians) / meridians;
      const Vector3d n(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                       std::sin(polar) * std::cos(azimuth));
      const Vector3d p = centre + radius * n;
      ball.positions_W.emplace_back(p.x(), p.y(), p.z());
      ball.normals_W.emplace_back(n.x(), n.y(), n.z());
    }
  }
  const auto at = [meridians](int i, int j) {
    return static_cast<uint32_t>(i * (meridians + 1) + j);
  };
  for (int i = 0; i < parallels; ++i) {
    for (int j = 0; j < meridians; ++j) {
      ball.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      ball.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  scene.meshes = {ball};
  return scene;
}

// A chord over an angle a lies up to r (1 − cos(a/2)) inside its circle, and a facet up to the sum
// for its two sides; a facet's normal leans by up to the two half angles.
TEST(Aovs, OfABallAreTheSpheresWithinItsFacets) {
  constexpr int kParallels = 150;
  constexpr double kRadius = 0.8;
  const Vector3d centre(0.1, -0.2, -1.0);
  const RayCaster caster(Ball(centre, kRadius, kParallels));
  const RayGrid rays(CameraModel::Pinhole(200, 160, 150.0));
  const Pose X_WC = FacingTheWall({0.3, 0.1, 1.5});
  const AovImages aovs = caster.CastAovs(rays, X_WC, Lighting{}, {});
  const double half_angle = 0.5 * std::numbers::pi / kParallels;
  const double sagitta = 2.0 * kRadius * (1.0 - std::cos(half_angle));
  int hits = 0;
  for (int v = 0; v < 160; ++v) {
    for (int u = 0; u < 200; ++u) {
      const Vector3d d = X_WC.rotation() * *rays.camera().UnprojectRay({u, v});
      const Vector3d m = X_WC.translation() - centre;
      const double a = d.squaredNorm();
      const double b = m.dot(d);
      const double discriminant = b * b - a * (m.squaredNorm() - kRadius * kRadius);
      const double cosine = std::sqrt(std::max(discriminant, 0.0)) / (std::sqrt(a) * kRadius);
      if (cosine < 0.2) {  // Within the limb's facets either answer is right.
        if (discriminant < -0.1 * a) {
          EXPECT_EQ(aovs.object_id(v, u), -1);
        }
        continue;
      }
      ++hits;
      const double depth = (-b - std::sqrt(discriminant)) / a;
      EXPECT_GT(aovs.depth_m(v, u), depth - 1e-6);
      EXPECT_LT(aovs.depth_m(v, u), depth + sagitta / cosine * 1.1 + 1e-6);
      const Vector3d n_W = (m + depth * d) / kRadius;
      const cv::Vec3f n = aovs.normal_C(v, u);
      const Vector3d found_W = X_WC.rotation() * Vector3d(n[0], n[1], n[2]);
      EXPECT_LT((found_W - n_W).norm(), 3.0 * half_angle);
    }
  }
  EXPECT_GT(hits, 5000);
}

// Sunlight on a smooth ball follows the sphere's cosine, not its facets'.
TEST(Radiance, OfASmoothBallIsThatOfASphere) {
  const Vector3d centre(0.0, 0.0, 0.0);
  const RayCaster caster(Ball(centre, 0.8, 40), {.bounces = 0});
  const RayGrid rays(CameraModel::Pinhole(120, 120, 120.0));
  const Pose X_WC = FacingTheWall({0.0, 0.0, 3.0});
  const Lighting lighting = OnlySun(0.3, 0.5, 1e4);
  const cv::Mat1f image = caster.Render(rays, X_WC, lighting, {}, RandomStream(1));
  int compared = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 120; ++u) {
      const Vector3d d = X_WC.rotation() * *rays.camera().UnprojectRay({u, v});
      const Vector3d m = X_WC.translation();
      const double b = m.dot(d);
      const double discriminant = b * b - d.squaredNorm() * (m.squaredNorm() - 0.64);
      if (discriminant < 0.2) continue;
      const Vector3d n = (m + (-b - std::sqrt(discriminant)) / d.squaredNorm() * d) / 0.8;
      const double cosine = n.dot(lighting.sun.Direction_W());
      if (cosine < 0.25) continue;  // Near the terminator facets face away.
      ++compared;
      // Linear interpolation over facets of 4.5 degrees: a²/8 = 0.0008; four samples in a pixel of
      // 1.5 degrees leave 0.005.
      EXPECT_NEAR(image(v, u), 0.5 / std::numbers::pi * 1e4 * cosine,
                  0.5 / std::numbers::pi * 1e4 * 0.012)
          << u << ", " << v;
    }
  }
  EXPECT_GT(compared, 1000);
}

// From inside a closed room a hundred million rays in all directions, a part of them aimed at the
// edges and vertices that its faces share.
TEST(TracedScene, AClosedRoomHasNoHoleForAHundredMillionRays) {
  const auto cell = [](double) { return 0.31; };
  const std::vector<float> breaks = GradedBreaks({-2.0, -1.7, 1.7, 2.0}, cell);
  SolidLattice lattice({breaks, breaks, breaks});
  lattice.Fill({{-2, -2, -2}, {2, 2, 2}}, 1);
  lattice.Fill({{-1.7, -1.7, -1.7}, {1.7, 1.7, 1.7}}, kAir);
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = {lattice.Surface(1, SolidLattice::Faces::kAll, "room", 0)};
  const TracedScene traced(scene);
  const TriangleSoup& soup = traced.opaque();

  constexpr int kPackets = 100'000'000 / kLanes;
  constexpr int kPacketsPerOrigin = 4096;
  const LaneMask all = FirstLanes(kLanes);
  int missed = 0;
  RandomStream random(11);
  std::vector<float> uniforms(static_cast<size_t>(3 * kPacketsPerOrigin * kLanes));
  for (int packet = 0; packet < kPackets; packet += kPacketsPerOrigin) {
    const RandomStream stream = random.Child("origin", static_cast<uint64_t>(packet));
    stream.Child("directions").FillUniforms(uniforms);
    const glm::vec3 origin(stream.Uniform(0) - 0.5, stream.Uniform(1) - 0.5,
                           stream.Uniform(2) - 0.5);
    size_t next = 0;
    for (int i = 0; i < kPacketsPerOrigin; ++i) {
      Directions directions;
      for (int lane = 0; lane < kLanes; ++lane) {
        const float a = uniforms[next++];
        const float b = uniforms[next++];
        const float c = uniforms[next++];
        glm::vec3 d(a - 0.5f, b - 0.5f, c - 0.5f);
        if (lane % 2 == 0) {
          // At a point of an edge, or at its end.
          const auto t = static_cast<size_t>(a * static_cast<float>(soup.size()));
          const glm::uvec3& corners = soup.triangles[std::min(t, soup.size() - 1)];
          const glm::vec3& p = soup.positions_W[corners.x];
          const glm::vec3& q = soup.positions_W[b < 0.5f ? corners.y : corners.z];
          d = p + (c < 0.2f ? 0.0f : c) * (q - p) - origin;
        }
        directions.x[lane] = d.x;
        directions.y[lane] = d.y;
        directions.z[lane] = d.z;
      }
      RayPacket rays;
      SetRays(rays, origin, directions);
      traced.all_tracer().Intersect(all, rays, Coherence::kIncoherent);
      for (int lane = 0; lane < kLanes; ++lane) {
        missed += rays.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(missed, 0);
}

}  // namespace
}  // namespace fenestra
