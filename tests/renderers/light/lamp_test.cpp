#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderers/light/diffuse_light.h"
#include "renderers/ray_caster.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

Scene WallAndLamp(const Lamp& lamp) {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = {UprightRectangle(-5, -5, 5, 5, 0.0f, 0)};
  scene.lamps = {lamp};
  return scene;
}

const CameraModel& Camera() {
  static const CameraModel camera = CameraModel::Pinhole(161, 121, 100.0);
  return camera;
}

cv::Mat1f Render(const Scene& scene, Band band = Band::kLuminance) {
  return RayCaster(scene).Render(RayGrid(Camera()), FacingTheWall({0, 0, 2}), OnlySky(0.0, 0.0),
                                 {.band = band, .samples_per_pixel = 64}, RandomStream(1));
}

// Where the wall is that a pixel sees.
Eigen::Vector3d OnWall(int u, int v) {
  return FacingTheWall({0, 0, 2}) * Eigen::Vector3d(2.0 * *Camera().UnprojectRay({u, v}));
}

TEST(Lamp, LightsAWallByTheInverseSquareAndTheCosine) {
  const Lamp lamp{.p_WL = {0.3, 0.2, 1.5}, .intensity_rgb = glm::vec3(200.0f)};
  const cv::Mat1f image = Render(WallAndLamp(lamp));
  for (int v = 0; v < 121; v += 10) {
    for (int u = 0; u < 161; u += 10) {
      const Eigen::Vector3d to_lamp = lamp.p_WL - OnWall(u, v);
      const double E = 200.0 * to_lamp.z() / std::pow(to_lamp.norm(), 3);
      // The mean over a pixel of 2 cm: its middle's value to (0.02/1.5)²/4 or so.
      EXPECT_NEAR(image(v, u), 0.5 / std::numbers::pi * E, 1e-4 * E) << u << ", " << v;
    }
  }
}

TEST(Lamp, ShadowsAreThoseOfARayFromEachPoint) {
  const Lamp lamp{.p_WL = {0.3, 0.2, 1.5}, .intensity_rgb = glm::vec3(200.0f)};
  Scene scene = WallAndLamp(lamp);
  // Seen edge-on by nobody: out of the camera's view of the wall but for its shadow.
  scene.meshes.push_back(UprightRectangle(0.2f, 0.1f, 0.4f, 0.3f, 1.0f, 0));
  scene.materials.push_back(Grey(0.0f));
  scene.meshes.back().material = 1;
  const cv::Mat1f image = Render(scene);
  const cv::Mat1f without = Render(WallAndLamp(lamp));
  int dark = 0;
  for (int v = 0; v < 121; ++v) {
    for (int u = 0; u < 161; ++u) {
      const Eigen::Vector3d q = OnWall(u, v);
      // At z = 1, two thirds of the way to the lamp; and half of the way to the camera.
      const Eigen::Vector3d at_plate = q + (lamp.p_WL - q) * (1.0 / 1.5);
      const Eigen::Vector3d seen = 0.5 * q;
      const auto outside = [](const Eigen::Vector3d& p) {
        return std::max(std::abs(p.x() - 0.3), std::abs(p.y() - 0.2)) - 0.1;
      };
      if (outside(seen) < 0.02 || std::abs(outside(at_plate)) < 0.02) continue;
      const bool shadow = outside(at_plate) < 0.0;
      dark += shadow ? 1 : 0;
      EXPECT_FLOAT_EQ(image(v, u), shadow ? 0.0f : without(v, u)) << u << ", " << v;
    }
  }
  EXPECT_GT(dark, 300);
}

TEST(Lamp, AConeHasItsFullIntensityInsideAndNoneOutside) {
  Lamp lamp{.p_WL = {0.0, 0.0, 1.0}, .intensity_rgb = glm::vec3(100.0f)};
  lamp.cone = {.axis_W = -Eigen::Vector3d::UnitZ(), .inner_rad = 0.3, .outer_rad = 0.6};
  Lamp bare = lamp;
  bare.cone.reset();
  const auto ratio = [&](double angle) {
    const glm::vec3 p(std::tan(angle), 0.0f, 0.0f);
    const glm::vec3 n(0.0f, 0.0f, 1.0f);
    return LampIrradiance(lamp, p, n) / LampIrradiance(bare, p, n);
  };
  EXPECT_FLOAT_EQ(ratio(0.0), 1.0f);
  EXPECT_FLOAT_EQ(ratio(0.29), 1.0f);
  EXPECT_EQ(ratio(0.61), 0.0f);
  const double rim = (std::cos(0.45) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
  EXPECT_NEAR(ratio(0.45), rim * rim, 1e-5);
}

TEST(Lamp, HasTheInfraredThatItIsSaidToHave) {
  Lamp lamp{.p_WL = {0.0, 0.0, 1.5}, .intensity_rgb = glm::vec3(200.0f)};
  EXPECT_EQ(cv::norm(Render(WallAndLamp(lamp), Band::kInfrared), cv::NORM_INF), 0.0);
  lamp.irradiance_830_per_lux = 2e-5;
  const double E = 200.0 * 2e-5 / (1.5 * 1.5);
  EXPECT_NEAR(Render(WallAndLamp(lamp), Band::kInfrared)(60, 80), 0.5 / std::numbers::pi * E,
              1e-4 * E);
}

}  // namespace
}  // namespace fenestra
