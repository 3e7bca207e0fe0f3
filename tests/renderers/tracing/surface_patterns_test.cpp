#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/random_stream.h"
#include "renderers/ray_caster.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

constexpr double kPi = std::numbers::pi;

// sRGB's 188 is 0.503 of the light: IEC 61966-2-1.
double Linear(int code) {
  const double s = code / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

Texture Noise(int size, uint64_t seed) {
  Texture texture{.name = "noise", .width_px = size, .height_px = size, .texels = {}};
  const RandomStream random(seed);
  for (uint64_t i = 0; i < static_cast<uint64_t>(size) * static_cast<uint64_t>(size); ++i) {
    const auto grey = static_cast<uint8_t>(255.0 * random.Uniform(i));
    texture.texels.emplace_back(grey, grey / 2, 255 - grey, 255);
  }
  return texture;
}

// A square of 2 m with the whole texture on it, its top left at the texture's.
Scene Poster(Texture texture) {
  Scene scene;
  scene.materials = {Grey(0.8f)};
  scene.materials[0].texture = 0;
  scene.textures = {std::move(texture)};
  scene.meshes = {UprightRectangle(-1, -1, 1, 1, 0.0f, 0)};
  scene.meshes[0].texture_coordinates = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  return scene;
}

cv::Mat RenderPoster(const Scene& scene, int size_px, Band band = Band::kLuminance) {
  // The poster fills the image.
  const RayGrid rays(CameraModel::Pinhole(size_px, size_px, 1.5 * size_px));
  return RayCaster(scene).Render(rays, FacingTheWall({0, 0, 3}), OnlySky(1e4, 1.0), {.band = band},
                                 RandomStream(1));
}

constexpr double kPerReflectance = 0.8 / kPi * 1e4;

TEST(Pattern, StandsOnTheSurfaceWhereItsCoordinatesSay) {
  Texture texture{.name = "four", .width_px = 2, .height_px = 2, .texels = {}};
  texture.texels = {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {188, 188, 188, 255}};
  texture.interpolated = false;
  const cv::Mat image = RenderPoster(Poster(texture), 64, Band::kRgb);
  const auto expect = [&](int u, int v, double r, double g, double b) {
    const auto bgr = image.at<cv::Vec3f>(v, u);
    EXPECT_NEAR(bgr[2], r * kPerReflectance, 1e-4 * kPerReflectance);
    EXPECT_NEAR(bgr[1], g * kPerReflectance, 1e-4 * kPerReflectance);
    EXPECT_NEAR(bgr[0], b * kPerReflectance, 1e-4 * kPerReflectance);
  };
  expect(10, 10, 1, 0, 0);
  expect(50, 10, 0, 1, 0);
  expect(10, 50, 0, 0, 1);
  expect(50, 50, Linear(188), Linear(188), Linear(188));
}

TEST(Pattern, KeepsTheMeanReflectanceAtAnyDistance) {
  const Texture texture = Noise(128, 7);
  double mean = 0.0;
  for (const glm::u8vec4& t : texture.texels) {
    mean += (0.2126 * Linear(t.r) + 0.7152 * Linear(t.g) + 0.0722 * Linear(t.b)) /
            static_cast<double>(texture.texels.size());
  }
  for (const int size_px : {256, 64, 16}) {
    const double L = cv::mean(RenderPoster(Poster(texture), size_px))[0];
    // Border texels are weighted differently under linear interpolation with wrap-around; the
    // samples leave the rest: 0.3 of the contrast over the root of 4 · 16² samples.
    EXPECT_NEAR(L, mean * kPerReflectance, 0.02 * mean * kPerReflectance) << size_px;
  }
}

// What cannot be resolved is averaged, not picked: a pixel that covers 16 texels has little noise.
TEST(Pattern, FarAwayIsFiltered) {
  const cv::Mat1f image = RenderPoster(Poster(Noise(256, 8)), 64);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(image, mean, deviation);
  // Independent texels of deviation 0.28 of full: 16 averaged leave a quarter; the twin with one
  // sample of one texel would have it all.
  EXPECT_LT(deviation[0], 0.35 * 0.45 * kPerReflectance * 0.5);
  EXPECT_GT(deviation[0], 0.005 * kPerReflectance);
}

TEST(Pattern, ActsAt830ByItsLuminance) {
  Texture texture{.name = "one", .width_px = 1, .height_px = 1, .texels = {{255, 128, 0, 255}}};
  Scene scene = Poster(texture);
  scene.materials[0].reflectance_830nm = 0.5f;
  const cv::Mat1f image = RenderPoster(scene, 16, Band::kInfrared);
  const double expected =
      0.5 / kPi * 1e4 * kDaylightIrradiance830PerLux * (0.2126 + 0.7152 * Linear(128));
  EXPECT_NEAR(image(8, 8), expected, 1e-4 * expected);
}

TEST(Pattern, VertexColoursAreInterpolated) {
  Scene scene;
  scene.materials = {Grey(0.8f)};
  scene.meshes = {UprightRectangle(-1, -1, 1, 1, 0.0f, 0)};
  scene.meshes[0].colors = {{0, 1, 0}, {1, 1, 0}, {1, 1, 0}, {0, 1, 0}};
  const cv::Mat image = RenderPoster(scene, 64, Band::kRgb);
  for (int u = 0; u < 64; ++u) {
    const auto bgr = image.at<cv::Vec3f>(20, u);
    // Four stratified samples of a linear function: off its middle by some part of a pixel.
    EXPECT_NEAR(bgr[2], (u + 0.5) / 64.0 * kPerReflectance, 0.5 / 64.0 * kPerReflectance) << u;
    EXPECT_NEAR(bgr[1], kPerReflectance, 1e-5 * kPerReflectance);
    EXPECT_EQ(bgr[0], 0.0f);
  }
}

// A plate with a hole in its texture before a wall: seen through it, and lit through it.
TEST(Pattern, HolesAreSeenThroughAndShoneThrough) {
  Texture texture{.name = "hole", .width_px = 4, .height_px = 4, .texels = {}};
  texture.interpolated = false;
  for (int i = 0; i < 16; ++i) {
    const bool hole = (i / 4 == 1 || i / 4 == 2) && (i % 4 == 1 || i % 4 == 2);
    texture.texels.emplace_back(255, 255, 255, hole ? 0 : 255);
  }
  Scene scene = Poster(texture);
  scene.materials[0].alpha_cutoff = 0.5f;
  scene.materials.push_back(Grey(0.3f));
  scene.meshes.push_back(UprightRectangle(-5, -5, 5, 5, -0.5f, 1));
  const RayCaster caster(scene);
  const RayGrid rays(CameraModel::Pinhole(200, 200, 300.0));
  const Lighting sun = OnlySun(0.2, 0.1, 1e4);
  const AovImages aovs = caster.CastAovs(rays, FacingTheWall({0, 0, 3}), sun, {});
  const Eigen::Vector3d to_sun = sun.sun.Direction_W();
  int lit = 0;
  for (int v = 0; v < 200; ++v) {
    for (int u = 0; u < 200; ++u) {
      const Eigen::Vector3d ray = *rays.camera().UnprojectRay({u, v});
      const Eigen::Vector3d on_plate = FacingTheWall({0, 0, 3}) * Eigen::Vector3d(3.0 * ray);
      const auto outside = [](const Eigen::Vector3d& p) {
        return std::max(std::abs(p.x()), std::abs(p.y())) - 0.5;
      };
      if (std::abs(outside(on_plate)) < 1e-4) continue;
      const bool through = outside(on_plate) < 0.0;
      ASSERT_EQ(aovs.object_id(v, u), through ? 1 : 0) << u << ", " << v;
      if (!through) continue;
      const Eigen::Vector3d p_WQ = FacingTheWall({0, 0, 3}) * Eigen::Vector3d(3.5 * ray);
      const Eigen::Vector3d towards_sun = p_WQ + to_sun * (0.5 / to_sun.z());
      if (std::abs(outside(towards_sun)) < 1e-3) continue;
      EXPECT_EQ(aovs.sees_sun(v, u), outside(towards_sun) < 0.0 ? 255 : 0);
      lit += outside(towards_sun) < 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 1000);
}

}  // namespace
}  // namespace fenestra
