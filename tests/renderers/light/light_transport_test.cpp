#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/core.hpp>

#include "renderers/ray_caster.h"
#include "scenes/facade/facade.h"
#include "scenes/targets/flat_targets.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

// Radiance is a handful of single-precision products and sums: some ten roundings of 6e-8.
constexpr double kRounding = 1e-6;

cv::Mat RenderFrom(const RayCaster& caster, const Pose& X_WC, const Lighting& lighting,
                   Band band = Band::kLuminance) {
  const RayGrid rays(DistortedCamera());
  return caster.Render(rays, X_WC, lighting, {.band = band}, RandomStream(1));
}

Pose Oblique() {
  return LookingAt({1.0, 0.6, 2.0}, {0.0, 0.0, 0.0});
}

void ExpectUniform(const cv::Mat& image, double value) {
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(image.reshape(1), &low, &high);
  EXPECT_NEAR(low, value, kRounding * value);
  EXPECT_NEAR(high, value, kRounding * value);
}

class BareWall : public ::testing::Test {
 protected:
  static PaperTargetOptions Options() {
    return {.wall_reflectance = 0.6, .wall_reflectance_830nm = 0.3, .with_target = false};
  }
  const RayCaster caster_{MakePaperTarget(Options())};
};

TEST_F(BareWall, UnderTheSunFollowsTheCosineLaw) {
  const Lighting lighting = OnlySun(0.4, 0.7, 6e4);
  const double cosine = lighting.sun.Direction_W().z();
  ExpectUniform(RenderFrom(caster_, Oblique(), lighting), 0.6 / std::numbers::pi * 6e4 * cosine);
}

TEST_F(BareWall, UnderTheSkySeesHalfOfItAndHalfOfTheGround) {
  const Lighting lighting = OnlySky(1e4, 0.2);
  ExpectUniform(RenderFrom(caster_, Oblique(), lighting),
                0.6 / std::numbers::pi * 1e4 * (0.5 + 0.5 * 0.2));
}

TEST_F(BareWall, IsDarkWithTheSunBehindItOrBelowTheHorizon) {
  EXPECT_EQ(cv::norm(RenderFrom(caster_, Oblique(), OnlySun(2.0, 0.5, 6e4)), cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(RenderFrom(caster_, Oblique(), OnlySun(0.3, -0.1, 6e4)), cv::NORM_INF), 0.0);
}

TEST_F(BareWall, IsWhiteInColourAndHasItsOwnReflectanceInTheInfrared) {
  const Lighting lighting = OnlySky(1e4, 0.0);
  const cv::Mat rgb = RenderFrom(caster_, Oblique(), lighting, Band::kRgb);
  ASSERT_EQ(rgb.type(), CV_32FC3);
  ExpectUniform(rgb, 0.6 / std::numbers::pi * 0.5e4);
  ExpectUniform(RenderFrom(caster_, Oblique(), lighting, Band::kInfrared),
                0.3 / std::numbers::pi * 0.5e4 * kDaylightIrradiance830PerLux);
}

TEST(Radiance, ChannelsAreBlueGreenRedAndLuminanceIsTheirRec709Sum) {
  Scene scene = MakePaperTarget({.with_target = false});
  scene.materials[0].reflectance_rgb = {0.2f, 0.4f, 0.8f};
  const RayCaster caster(scene);
  const double per_reflectance = 1e4 / std::numbers::pi / 2.0;
  const cv::Mat rgb = RenderFrom(caster, Oblique(), OnlySky(1e4, 0.0), Band::kRgb);
  const cv::Vec3f pixel = rgb.at<cv::Vec3f>(100, 100);
  EXPECT_NEAR(pixel[0], 0.8 * per_reflectance, kRounding * per_reflectance);
  EXPECT_NEAR(pixel[1], 0.4 * per_reflectance, kRounding * per_reflectance);
  EXPECT_NEAR(pixel[2], 0.2 * per_reflectance, kRounding * per_reflectance);
  ExpectUniform(RenderFrom(caster, Oblique(), OnlySky(1e4, 0.0)),
                (0.2126 * 0.2 + 0.7152 * 0.4 + 0.0722 * 0.8) * per_reflectance);
}

TEST(Radiance, IsLinearInEachLight) {
  const RayCaster caster(MakeFacade({.window = {.setback_m = 0.1}, .room = {.depth_m = 1.0}}));
  const Lighting sun = OnlySun(0.5, 0.6, 5e4);
  const Lighting sky = OnlySky(1e4, 0.2);
  Lighting both = sky;
  both.sun = sun.sun;
  Lighting more = sky;
  more.sun = sun.sun;
  more.sun.illuminance_lx *= 2.0;
  // Edge pixels are the same as long as the same things are seen, and that needs the same sun: its
  // shadow is an edge. So the dim sun stands for no sun.
  Lighting dim = sky;
  dim.sun = sun.sun;
  dim.sun.illuminance_lx = 1e-3;
  const cv::Mat with_both = RenderFrom(caster, Oblique(), both);
  const cv::Mat with_more = RenderFrom(caster, Oblique(), more);
  const cv::Mat with_dim = RenderFrom(caster, Oblique(), dim);
  // Differences of radiances up to 4e4 cd/m², of which each is rounded.
  EXPECT_LT(cv::norm(with_more - with_both, with_both - with_dim, cv::NORM_INF), 4e4 * 2e-6);
  EXPECT_GT(cv::norm(with_both, with_dim, cv::NORM_INF), 1e3);
}

TEST(Radiance, OfARayThatHitsNothingIsSkyOrGround) {
  const RayCaster caster(MakePaperTarget({}));
  const Pose away = LookingAt({0.0, 0.0, 2.0}, {0.0, 0.0, 3.0});
  const cv::Mat image = RenderFrom(caster, away, OnlySky(1e4, 0.25));
  EXPECT_FLOAT_EQ(image.at<float>(0, 50), static_cast<float>(1e4 / std::numbers::pi));
  EXPECT_FLOAT_EQ(image.at<float>(239, 50), static_cast<float>(0.25 * 1e4 / std::numbers::pi));
}

TEST(Radiance, OfASheetsBackIsThatOfItsFront) {
  Scene scene;
  scene.materials = {Grey(0.6f)};
  scene.meshes = {UprightRectangle(-50, -50, 50, 50, 0.0f, 0)};
  Scene reversed = scene;
  for (glm::uvec3& t : reversed.meshes[0].triangles) std::swap(t.y, t.z);
  Lighting lighting = OnlySun(0.4, 0.7, 5e4);
  lighting.sky.illuminance_lx = 1e4;
  const double E = 5e4 * lighting.sun.Direction_W().z() + 1e4 * 0.5;
  ExpectUniform(RenderFrom(RayCaster(scene), Oblique(), lighting), 0.6 / std::numbers::pi * E);
  ExpectUniform(RenderFrom(RayCaster(reversed), Oblique(), lighting), 0.6 / std::numbers::pi * E);
}

// On the frame, which stands `setback` behind the wall, the light from the sun passes the plane
// z = 0 displaced by setback · (dx, dy)/dz: a point is lit exactly if it does so in the opening.
TEST(SunShadow, OfTheRevealOnTheFrameFollowsTheGeometry) {
  constexpr double kSetback = 0.12;
  const Lighting lighting = OnlySun(0.5, 0.6, 5e4);
  const Eigen::Vector3d to_sun = lighting.sun.Direction_W();
  const RayCaster caster(MakeFacade({.window = {.setback_m = kSetback}, .room = {.depth_m = 1.0}}));
  const RayGrid rays(DistortedCamera());
  const Pose X_WC = FacingTheWall({0.05, 0.02, 1.0});
  const AovImages aovs = caster.CastAovs(rays, X_WC, lighting, {});
  int lit = 0;
  int shadowed = 0;
  for (int v = 0; v < rays.height_px(); ++v) {
    for (int u = 0; u < rays.width_px(); ++u) {
      if (aovs.object_id(v, u) != 1) continue;
      const Eigen::Vector3d ray = *rays.camera().UnprojectRay({u, v});
      const Eigen::Vector3d p_WQ = X_WC * (ray * aovs.depth_m(v, u));
      if (std::abs(p_WQ.z() + kSetback) > 1e-5) continue;  // A side of the frame.
      const Eigen::Vector3d at_wall = p_WQ + to_sun * (kSetback / to_sun.z());
      const double inside = 0.5 - std::max(std::abs(at_wall.x()), std::abs(at_wall.y()));
      // The penumbra is 4.65 mrad · setback/dz² = 1.1 mm wide to each side; shadow rays start some
      // 0.05 mm off the surface.
      if (std::abs(inside) < 1.2e-3) continue;
      EXPECT_EQ(aovs.sees_sun(v, u), inside > 0.0 ? 255 : 0) << u << ", " << v;
      ++(inside > 0.0 ? lit : shadowed);
    }
  }
  EXPECT_GT(lit, 1000);
  EXPECT_GT(shadowed, 1000);
}

}  // namespace
}  // namespace fenestra
