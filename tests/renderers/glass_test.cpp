#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "renderers/ray_caster.h"
#include "renderers/tracing/pane_kernels.h"
#include "scenes/facade/facade.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kGlassIndex = 1.52f;

// A wall at z = 0 with a pane, large enough to cover all of the image, at z = 0.5.
Scene WallBehindPane(float wall_reflectance) {
  Scene scene;
  scene.materials = {Grey(wall_reflectance), {.name = "glass", .kind = Material::Kind::kGlass}};
  scene.meshes = {UprightRectangle(-50, -50, 50, 50, 0.0f, 0),
                  UprightRectangle(-100, -100, 100, 100, 0.5f, 1)};
  return scene;
}

cv::Mat1f Render(const Scene& scene, const Lighting& lighting) {
  const RayGrid rays(DistortedCamera());
  return RayCaster(scene).Render(rays, FacingTheWall({0, 0, 2}), lighting, {}, RandomStream(1));
}

// Cosine of incidence at a pixel's centre, the pane being parallel to the image.
double CosineAt(int u, int v) {
  return 1.0 / DistortedCamera().UnprojectRay({u, v})->norm();
}

TEST(PaneReflectance, AtNormalIncidenceIsTheTextbookValue) {
  const double F = std::pow((1.52 - 1.0) / (1.52 + 1.0), 2);  // 0.0426
  EXPECT_NEAR(PaneReflectance(1.0f, kGlassIndex), 2.0 * F / (1.0 + F), 1e-6);
  EXPECT_NEAR(PaneReflectance(1.0f, kGlassIndex), 0.0817, 5e-5);
}

TEST(PaneReflectance, GrowsTowardsOneAtGrazingIncidence) {
  float last = PaneReflectance(1.0f, kGlassIndex);
  for (float c = 0.65f; c >= 0.0f; c -= 0.05f) {
    const float R = PaneReflectance(c, kGlassIndex);
    EXPECT_GT(R, last);
    last = R;
  }
  EXPECT_NEAR(PaneReflectance(0.0f, kGlassIndex), 1.0f, 1e-3f);
}

TEST(PaneReflectance, OfIndexOneIsNone) {
  for (const float c : {0.0f, 0.3f, 1.0f}) EXPECT_LT(PaneReflectance(c, 1.0f), 1e-6f);
}

TEST(Pane, DimsTheSunOnItsWayInAndTheWallOnItsWayOut) {
  Lighting lighting = OnlySun(0.3, 0.8, 5e4);
  lighting.sun.angular_diameter_rad = 0.0;  // The pane passes points of the disc unlike by 1e-4.
  const double sun_cosine = lighting.sun.Direction_W().z();
  const cv::Mat1f image = Render(WallBehindPane(0.7f), lighting);
  for (const auto& [u, v] : {std::pair{187, 119}, {10, 10}, {300, 200}}) {
    const double T_in =
        1.0 - static_cast<double>(PaneReflectance(static_cast<float>(sun_cosine), kGlassIndex));
    const double T_out =
        1.0 - static_cast<double>(PaneReflectance(static_cast<float>(CosineAt(u, v)), kGlassIndex));
    const double expected = 0.7 / kPi * 5e4 * sun_cosine * T_in * T_out;
    // The mean over a pixel departs from its centre by R'' px²/(24 f²) < 1e-5; then rounding.
    EXPECT_NEAR(image(v, u), expected, 2e-5 * expected);
  }
}

TEST(Pane, MirrorsSkyAndGround) {
  const cv::Mat1f image = Render(WallBehindPane(0.0f), OnlySky(1e4, 0.3));
  for (const auto& [u, v] : {std::pair{187, 20}, {10, 10}, {300, 200}, {20, 230}}) {
    const double R =
        static_cast<double>(PaneReflectance(static_cast<float>(CosineAt(u, v)), kGlassIndex));
    const double L = 1e4 / kPi * (v < 120 ? 1.0 : 0.3);  // The horizon is at row 119.5.
    EXPECT_NEAR(image(v, u), R * L, 2e-4 * R * L);       // As above; R varies faster than 1 - R.
  }
}

TEST(Pane, DimsTheSkyByItsMeanTransmittance) {
  // 2 ∫ T(c) c dc over the hemisphere, midpoint rule.
  double T_diffuse = 0.0;
  constexpr int kSteps = 10000;
  for (int i = 0; i < kSteps; ++i) {
    const double c = (i + 0.5) / kSteps;
    const double T = 1.0 - static_cast<double>(PaneReflectance(static_cast<float>(c), kGlassIndex));
    T_diffuse += 2.0 * T * c / kSteps;
  }
  const double T_out = 1.0 - static_cast<double>(PaneReflectance(1.0f, kGlassIndex));
  Scene scene = WallBehindPane(0.7f);
  // Small enough to be interpolated, with the pane reaching to the horizon as seen from it.
  scene.meshes[0] = UprightRectangle(-0.5, -0.5, 0.5, 0.5, 0.0f, 0);
  scene.meshes[1] = UprightRectangle(-500, -500, 500, 500, 0.5f, 1);
  Lighting lighting = OnlySky(1e4, 0.0);
  lighting.sky.ground_reflectance = 1.0;
  const cv::Mat1f image = Render(scene, lighting);
  const double R = static_cast<double>(PaneReflectance(1.0f, kGlassIndex));
  const double L_sky = 1e4 / kPi;
  const double expected = 0.7 * L_sky * T_diffuse * T_out + R * L_sky;
  // The baked sky's stated error under a pane that fills the hemisphere.
  EXPECT_NEAR(image(119, 187), expected, 0.003 * expected);
}

TEST(Pane, OfIndexOneIsNotThere) {
  Scene with_air = MakeFacade({.room = {.depth_m = 1.0}});
  for (Material& material : with_air.materials) material.refractive_index = 1.0f;
  const Scene without = MakeFacade({.window = {.glass = false}, .room = {.depth_m = 1.0}});
  Lighting lighting = OnlySun(0.4, 0.6, 5e4);
  lighting.sky.illuminance_lx = 1e4;
  // Only pixels at mirrored edges have other samples; their means agree to the sampling error.
  const cv::Mat1f a = Render(with_air, lighting);
  const cv::Mat1f b = Render(without, lighting);
  EXPECT_LT(cv::norm(a, b, cv::NORM_L1) / cv::norm(b, cv::NORM_L1), 1e-4);
  EXPECT_GT(cv::norm(Render(MakeFacade({.room = {.depth_m = 1.0}}), lighting), b, cv::NORM_L1) /
                cv::norm(b, cv::NORM_L1),
            1e-3);
}

}  // namespace
}  // namespace fenestra
