#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "renderers/light/diffuse_light.h"
#include "renderers/ray_caster.h"
#include "scenes/facade/facade.h"
#include "scenes/mesh/solid_lattice.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

constexpr double kPi = std::numbers::pi;

const Solid kShell = 1;

// A room of 2 m x 2 m x 2 m around the origin, closed on all sides.
Scene ClosedRoom(float reflectance, float emission) {
  const std::vector<float> breaks =
      GradedBreaks({-1.2, -1.0, 1.0, 1.2}, [](double) { return 0.51; });
  SolidLattice lattice({breaks, breaks, breaks});
  lattice.Fill({{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}}, kShell);
  lattice.Fill({{-1, -1, -1}, {1, 1, 1}}, kAir);
  Scene scene;
  scene.materials = {Grey(reflectance)};
  scene.materials[0].emission_rgb = glm::vec3(emission);
  scene.materials[0].emission_830nm = 0.001f * emission;
  scene.meshes = {lattice.Surface(kShell, SolidLattice::Faces::kAll, "room", 0)};
  return scene;
}

void ExpectUniformRadiance(const RayCaster& caster, double expected, double tolerance) {
  const RayGrid rays(CameraModel::Pinhole(64, 48, 40.0));
  const cv::Mat image = caster.Render(rays, LookingAt({0.2, 0.1, 0.3}, {0.5, -0.6, -0.9}),
                                      OnlySky(0.0, 0.0), {}, RandomStream(1));
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(image, &low, &high);
  EXPECT_NEAR(low, expected, tolerance * expected);
  EXPECT_NEAR(high, expected, tolerance * expected);
}

// In a furnace whose walls shine with L and reflect a, n bounces give L (1 + a + … + a^n), and all
// bounces L/(1 − a).
TEST(Interreflection, OfAFurnaceIsTheGeometricSeries) {
  constexpr double kL = 100.0;
  for (const double a : {0.0, 0.5, 0.8}) {
    const Scene room = ClosedRoom(static_cast<float>(a), static_cast<float>(kL));
    for (const int bounces : {0, 1, 2, 7}) {
      double series = 0.0;
      for (int k = 0; k <= bounces; ++k) series += std::pow(a, k);
      // Single precision: some thousand form factors are summed in each bounce.
      ExpectUniformRadiance(RayCaster(room, {.bounces = bounces}), kL * series, 2e-5);
    }
    ExpectUniformRadiance(RayCaster(room, {.bounces = 100}), kL / (1.0 - a), 1e-4);
  }
}

TEST(Interreflection, OfAFurnaceFollowsEachBandsOwnReflectance) {
  Scene room = ClosedRoom(0.8f, 100.0f);
  room.materials[0].reflectance_830nm = 0.25f;
  room.materials[0].reflectance_rgb.r = 0.5f;
  const RayCaster caster(room, {.bounces = 100});
  const RayGrid rays(CameraModel::Pinhole(16, 12, 10.0));
  const auto centre = [&](Band band) -> cv::Mat {
    return caster.Render(rays, FacingTheWall({0, 0, 0.5}), OnlySky(0.0, 0.0), {.band = band},
                         RandomStream(1));
  };
  EXPECT_NEAR(centre(Band::kInfrared).at<float>(5, 5), 0.1 / 0.75, 1e-4 * 0.1 / 0.75);
  const auto bgr = centre(Band::kRgb).at<cv::Vec3f>(5, 5);
  EXPECT_NEAR(bgr[0], 500.0, 0.05);
  EXPECT_NEAR(bgr[2], 200.0, 0.02);
}

// A floor of 2 m x 2 m under the sun at the zenith before a wall: the wall gets by one bounce
// E = ∫ ρ E_sun cos θ₁ cos θ₂ / (π r²) dA.
TEST(Interreflection, OfASunlitFloorLightsTheWallByItsFormFactor) {
  constexpr double kSun_lx = 5e4;
  const std::vector<float> breaks = GradedBreaks({0.0, 2.0}, [](double) { return 0.13; });
  Scene scene;
  scene.materials = {Grey(0.6f), Grey(1.0f)};
  Mesh floor{.name = "floor", .material = 0};
  for (const float z : breaks) {
    for (const float x : breaks) floor.positions_W.emplace_back(x - 1.0f, 0.0f, z);
  }
  const auto n = static_cast<uint32_t>(breaks.size());
  for (uint32_t i = 0; i + 1 < n; ++i) {
    for (uint32_t j = 0; j + 1 < n; ++j) {
      const uint32_t a = i * n + j;
      floor.triangles.push_back({a, a + n, a + 1});
      floor.triangles.push_back({a + 1, a + n, a + n + 1});
    }
  }
  // A small piece of the wall: its light is all but constant on it.
  scene.meshes = {floor, UprightRectangle(-0.01f, 0.49f, 0.01f, 0.51f, 0.0f, 1)};
  const RayCaster caster(scene, {.bounces = 1});
  const RayGrid rays(CameraModel::Pinhole(9, 9, 1000.0));
  const cv::Mat1f image = caster.Render(rays, FacingTheWall({0.0, 0.5, 1.0}),
                                        OnlySun(0.0, 0.5 * kPi, kSun_lx), {}, RandomStream(1));
  double E = 0.0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = -1.0 + 2.0 * (i + 0.5) / kSteps;
      const double z = 2.0 * (j + 0.5) / kSteps;
      const double rr = x * x + 0.25 + z * z;
      E += 0.6 * kSun_lx * (z * 0.5) / (kPi * rr * rr) * std::pow(2.0 / kSteps, 2);
    }
  }
  // The form factors' stated error, 0.001 to 0.002 of the whole hemisphere, of this part of it.
  EXPECT_NEAR(image(4, 4), E / kPi, 0.002 * 0.6 * kSun_lx / kPi);
  EXPECT_GT(E, 0.05 * kSun_lx);
}

double MeanRoomRadiance(double room_reflectance, double ground_reflectance) {
  const RayCaster caster(MakeFacade(
      {.window = {.glass = false}, .room = {.paint = {.reflectance = room_reflectance}}}));
  Lighting lighting = OnlySun(0.3, 0.6, 5e4);
  lighting.sky.illuminance_lx = 1e4;
  lighting.sky.ground_reflectance = ground_reflectance;
  const RayGrid rays(CameraModel::Pinhole(64, 64, 200.0));  // Only the room, through the window.
  return cv::mean(
      caster.Render(rays, FacingTheWall({0, 0, 1.5}), lighting, {}, RandomStream(1)))[0];
}

TEST(Interreflection, ABlackRoomAndAWhiteCourtyardDiffer) {
  const double black = MeanRoomRadiance(0.02, 0.2);
  const double grey = MeanRoomRadiance(0.4, 0.2);
  const double white = MeanRoomRadiance(0.8, 0.2);
  // More than in proportion to the reflectance: light that has bounced bounces again.
  EXPECT_GT(grey / black, 1.2 * 0.4 / 0.02);
  EXPECT_GT(white / grey, 1.2 * 0.8 / 0.4);
  EXPECT_GT(MeanRoomRadiance(0.4, 0.8), 1.2 * grey);
}

TEST(Interreflection, ALightTurnedOffTakesAwayExactlyItsPart) {
  Scene scene = MakeFacade({.window = {.glass = false}});
  scene.materials[2].emission_rgb = glm::vec3(5.0f);
  scene.lamps = {{.name = "lamp", .p_WL = {0.0, 1.0, -2.0}, .intensity_rgb = glm::vec3(300.0f)}};
  const RayCaster caster(scene);
  const RayGrid rays(DistortedCamera());
  const Pose X_WC = LookingAt({0.5, 0.2, 1.5}, {0.0, 0.0, 0.0});
  // Without adaptive sampling, which follows the shadows that are there.
  const RenderOptions options{.edge_samples_per_pixel = 4};
  Lighting all = OnlySun(0.5, 0.6, 5e3);
  all.sky = {.model = Sky::Model::kCieClear, .illuminance_lx = 1e3};
  const auto render = [&](bool sun, bool sky, bool lamp) -> cv::Mat {
    Lighting lighting = all;
    if (!sun) lighting.sun.illuminance_lx = 0.0;
    if (!sky) lighting.sky.illuminance_lx = 0.0;
    lighting.lamp_dimmer = lamp ? 1.0 : 0.0;
    return caster.Render(rays, X_WC, lighting, options, RandomStream(1));
  };
  const cv::Mat together = render(true, true, true);
  const cv::Mat glow = render(false, false, false);
  const cv::Mat parts = render(true, false, false) + render(false, true, false) +
                        render(false, false, true) - 2 * glow;
  double brightest = 0.0;
  cv::minMaxLoc(together, nullptr, &brightest);
  EXPECT_LT(cv::norm(together, parts, cv::NORM_INF), 2e-6 * brightest);
  EXPECT_GT(cv::norm(glow, cv::NORM_INF), 1.0);
}

TEST(Interreflection, WhatIsRememberedIsWhatWouldBeFoundAgain) {
  const Scene scene = MakeFacade({});
  const RayCaster fresh(scene);
  const RayCaster used(scene);
  const RayGrid rays(CameraModel::Pinhole(64, 48, 60.0));
  const auto render = [&](const RayCaster& caster, double azimuth) -> cv::Mat {
    return caster.Render(rays, FacingTheWall({0, 0, 2}), OnlySun(azimuth, 0.5, 5e4), {},
                         RandomStream(1));
  };
  for (int i = 0; i < 40; ++i) render(used, 0.02 * i);  // More than are remembered.
  const cv::Mat a = render(used, 0.1);
  const cv::Mat b = render(fresh, 0.1);
  EXPECT_EQ(std::memcmp(a.data, b.data, a.total() * a.elemSize()), 0);
}

}  // namespace
}  // namespace fenestra
