#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/io/input_error.h"
#include "renderers/ray_caster.h"
#include "renderers/tracing/pane_kernels.h"
#include "scenes/facade/facade.h"
#include "scenes/targets/flat_targets.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

Pose Oblique() {
  return LookingAt({1.0, 0.6, 2.0}, {0.0, 0.0, 0.0});
}

// Depth at which a camera's ray meets the plane z = 0.
double DepthOfWall(const Pose& X_WC, const Vector3d& ray_C) {
  return -X_WC.translation().z() / (X_WC.rotation() * ray_C).z();
}

TEST(Aovs, DepthAndNormalOfAPlaneAreExactToSinglePrecision) {
  const RayCaster caster(MakePaperTarget({}));
  const RayGrid rays(DistortedCamera());
  const AovImages aovs = caster.CastAovs(rays, Oblique(), Lighting{}, {});
  const Vector3d normal_C = Oblique().rotation().transpose() * Vector3d::UnitZ();
  for (int v = 0; v < rays.height_px(); v += 7) {
    for (int u = 0; u < rays.width_px(); u += 5) {
      const double depth = DepthOfWall(Oblique(), *rays.camera().UnprojectRay({u, v}));
      EXPECT_NEAR(aovs.depth_m(v, u), depth, 1e-6 * depth) << u << ", " << v;
      const cv::Vec3f n = aovs.normal_C(v, u);
      EXPECT_LT((Vector3d(n[0], n[1], n[2]) - normal_C).norm(), 1e-6);
    }
  }
}

// Frames, reveals and the room lie where the options say, so each pixel's point is on a plane of
// the building: of all faces, of all objects.
TEST(Aovs, OfAFacadeLieOnItsPlanes) {
  const FacadeOptions o{.window = {.setback_m = 0.1}};
  const RayCaster caster(MakeFacade(o));
  const RayGrid rays(DistortedCamera());
  for (const Vector3d& p_WC : {Vector3d(0.0, 0.0, 1.2), Vector3d(0.8, 0.5, 0.7)}) {
    const Pose X_WC = LookingAt(p_WC, {0.0, 0.0, -0.2});
    const AovImages aovs = caster.CastAovs(rays, X_WC, Lighting{}, {});
    int seen[3] = {};
    for (int v = 0; v < rays.height_px(); ++v) {
      for (int u = 0; u < rays.width_px(); ++u) {
        const int object = aovs.object_id(v, u);
        ASSERT_TRUE(object >= 0 && object <= 2) << "a hole at " << u << ", " << v;
        ++seen[object];
        const Vector3d p = X_WC * (*rays.camera().UnprojectRay({u, v}) * aovs.depth_m(v, u));
        const cv::Vec3f n = aovs.normal_C(v, u);
        const Vector3d n_W = X_WC.rotation() * Vector3d(n[0], n[1], n[2]);
        if (n_W.z() < 0.9) continue;
        const double z = object == 0 ? 0.0 : object == 1 ? -0.1 : -4.3;
        EXPECT_NEAR(p.z(), z, 5e-6) << u << ", " << v;  // 1e-6 of some 5 m.
      }
    }
    for (const int count : seen) EXPECT_GT(count, 500);
  }
}

TEST(Aovs, WhereNothingIsHitSayNothing) {
  const RayCaster caster(MakePaperTarget({}));
  const RayGrid rays(DistortedCamera());
  AovOptions options;
  options.p_WP = Vector3d(0.0, 0.0, 2.0);
  const Pose away = LookingAt({0.0, 0.0, 2.0}, {0.0, 0.0, 3.0});
  const AovImages aovs = caster.CastAovs(rays, away, Lighting{}, options);
  EXPECT_EQ(cv::countNonZero(aovs.depth_m == aovs.depth_m), 0);  // All NaN.
  EXPECT_EQ(cv::countNonZero(aovs.object_id != -1), 0);
  EXPECT_EQ(cv::countNonZero(aovs.sees_sun), 0);
  EXPECT_EQ(cv::countNonZero(aovs.sees_point), 0);
  EXPECT_EQ(cv::norm(aovs.normal_C, cv::NORM_INF), 0.0);
}

TEST(Aovs, AmbientIrradianceIsThatOfTheLights) {
  const RayCaster caster(MakePaperTarget({.with_target = false}));
  Lighting lighting = OnlySun(0.4, 0.6, 5e4);
  lighting.sky = {.illuminance_lx = 1e4, .ground_reflectance = 0.2};
  // The ground, which the sun lights too, fills half of what the wall sees.
  const double ground_lx = 0.2 * (1e4 + 5e4 * lighting.sun.Direction_W().y());
  const double lux = 5e4 * lighting.sun.Direction_W().z() + 0.5 * 1e4 + 0.5 * ground_lx;
  const RayGrid rays(DistortedCamera());
  AovImages aovs = caster.CastAovs(rays, Oblique(), lighting, {});
  EXPECT_NEAR(aovs.irradiance_lx(50, 60), lux, 1e-6 * lux);
  const double expected = lux * kDaylightIrradiance830PerLux;
  EXPECT_NEAR(aovs.irradiance_830(50, 60), expected, 1e-6 * expected);
  EXPECT_EQ(aovs.sees_sun(50, 60), 255);
  EXPECT_FLOAT_EQ(aovs.reflectance_830nm(50, 60), 0.8f);

  lighting.irradiance_830_per_lux = 0.0;  // The sun is seen even without its infra-red.
  aovs = caster.CastAovs(rays, Oblique(), lighting, {});
  EXPECT_EQ(aovs.irradiance_830(50, 60), 0.0f);
  EXPECT_EQ(aovs.sees_sun(50, 60), 255);
}

TEST(Aovs, GlassIsSeenThroughAndDims) {
  const RayCaster caster(MakeFacade({}));
  const RayGrid rays(CameraModel::Pinhole(201, 201, 200.0));
  const AovImages aovs = caster.CastAovs(rays, FacingTheWall({0, 0, 2}), Lighting{}, {});
  EXPECT_EQ(aovs.object_id(100, 100), 2);            // The room,
  EXPECT_NEAR(aovs.depth_m(100, 100), 6.3, 6.3e-6);  // whose back is 4.3 m behind the facade.
  EXPECT_NEAR(aovs.transmittance(100, 100), 1.0f - PaneReflectance(1.0f, 1.52f), 1e-6f);
  EXPECT_EQ(aovs.transmittance(100, 5), 1.0f);
}

TEST(Aovs, OffsetsLookWhereTheySayEvenBeyondTheBorder) {
  const RayCaster caster(MakePaperTarget({.wall_width_m = 40.0, .wall_height_m = 40.0}));
  const CameraModel camera = CameraModel::Pinhole(64, 48, 60.0);
  const RayGrid rays(camera);
  AovOptions options;
  options.offsets_px = cv::Mat2f(48, 64);
  const RandomStream random(5);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const auto i = static_cast<uint64_t>(v * 64 + u);
      options.offsets_px(v, u) =
          cv::Vec2f(static_cast<float>(128.0 * random.Child("u").Uniform(i) - 64.0),
                    static_cast<float>(128.0 * random.Child("v").Uniform(i) - 64.0));
    }
  }
  const Pose X_WC = LookingAt({0.5, 0.3, 2.0}, {0.0, 0.0, 0.0});
  const AovImages aovs = caster.CastAovs(rays, X_WC, Lighting{}, options);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const cv::Vec2f& d = options.offsets_px(v, u);
      const Vector3d ray = *camera.UnprojectRay(Eigen::Vector2d(u + d[0], v + d[1]));
      const double depth = DepthOfWall(X_WC, ray);
      // The spacing of single-precision corners, good to 1.2e-7, is extrapolated over up to 64 px:
      // 8e-6 of slope. Depth changes by at most 4 times its relative part on this oblique wall.
      EXPECT_NEAR(aovs.depth_m(v, u), depth, 4.0 * 8e-6 * depth) << u << ", " << v;
    }
  }
}

TEST(Aovs, BadOffsetsAreRefused) {
  const RayCaster caster(MakePaperTarget({}));
  const RayGrid rays(CameraModel::Pinhole(64, 48, 60.0));
  AovOptions options;
  options.offsets_px = cv::Mat2f(48, 64, cv::Vec2f(0.0f, 64.5f));
  EXPECT_THROW(caster.CastAovs(rays, Oblique(), Lighting{}, options), InputError);
  options.offsets_px = cv::Mat2f(48, 63, cv::Vec2f(0.0f, 0.0f));
  EXPECT_THROW(caster.CastAovs(rays, Oblique(), Lighting{}, options), InputError);
}

// The wall at z = 0 behind a plate at z = 0.5 that covers |x|, |y| < 0.25: of the wall, P sees what
// is not in the plate's shadow as cast by P.
TEST(SeesPoint, IsOcclusionByWhatStandsBetween) {
  Scene scene;
  scene.materials = {Grey(0.5f), {.name = "glass", .kind = Material::Kind::kGlass}};
  scene.meshes = {UprightRectangle(-5, -5, 5, 5, 0.0f, 0),
                  UprightRectangle(-0.25f, -0.25f, 0.25f, 0.25f, 0.5f, 0),
                  UprightRectangle(-5, -5, 5, 5, 1.0f, 1)};  // Seen through by both.
  const RayCaster caster(scene);
  const RayGrid rays(CameraModel::Pinhole(200, 200, 150.0));
  const Pose X_WC = FacingTheWall({0.0, 0.0, 2.0});
  AovOptions options;
  const Vector3d p_WP(0.3, 0.1, 2.0);
  options.p_WP = p_WP;
  const AovImages aovs = caster.CastAovs(rays, X_WC, Lighting{}, options);
  int hidden = 0;
  for (int v = 0; v < 200; ++v) {
    for (int u = 0; u < 200; ++u) {
      if (aovs.object_id(v, u) == 1) {
        EXPECT_EQ(aovs.sees_point(v, u), 255);  // Its front is in plain view.
        continue;
      }
      const Vector3d p_WQ = X_WC * (*rays.camera().UnprojectRay({u, v}) * aovs.depth_m(v, u));
      const Vector3d at_plate = p_WQ + 0.25 * (p_WP - p_WQ);
      const double outside = std::max(std::abs(at_plate.x()), std::abs(at_plate.y())) - 0.25;
      if (std::abs(outside) < 1e-4) continue;
      EXPECT_EQ(aovs.sees_point(v, u), outside > 0.0 ? 255 : 0) << u << ", " << v;
      hidden += outside < 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(hidden, 300);
}

TEST(SeesPoint, IsFalseFromTheSurfacesOtherSide) {
  const RayCaster caster(MakePaperTarget({}));
  const RayGrid rays(CameraModel::Pinhole(64, 48, 60.0));
  AovOptions options;
  options.p_WP = Vector3d(0.0, 0.0, -2.0);
  const AovImages aovs = caster.CastAovs(rays, FacingTheWall({0, 0, 2}), Lighting{}, options);
  EXPECT_EQ(cv::countNonZero(aovs.sees_point), 0);
}

}  // namespace
}  // namespace fenestra
