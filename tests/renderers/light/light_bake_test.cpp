#include "renderers/light/light_bake.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "renderers/ray_caster.h"
#include "scenes/facade/facade.h"
#include "scenes/targets/flat_targets.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

// The error that the header states.
constexpr double kBakingError = 0.002;
// Some hundred single-precision numbers of random rounding, and three products.
constexpr double kBakeRounding = 3e-7;

// View factor from a small parallel surface to an a x b rectangle at distance c, one corner of
// which stands straight before it. Source: M. F. Modest, "Radiative Heat Transfer", appendix D,
// configuration 10.
double CornerViewFactor(double a, double b, double c) {
  const double A = a / c;
  const double B = b / c;
  const double rA = std::sqrt(1.0 + A * A);
  const double rB = std::sqrt(1.0 + B * B);
  return (A / rA * std::atan(B / rA) + B / rB * std::atan(A / rB)) / (2.0 * std::numbers::pi);
}

LightBake Bake(const TracedScene& traced) {
  return BakeLight(traced, NumberSurfaces(traced.opaque()));
}

// What a point sees, as parts of what a horizontal surface sees of all sky, and of surfaces.
struct View {
  double sky = 0.0;
  double ground = 0.0;
  double surfaces = 0.0;

  double all() const { return sky + ground + surfaces; }
};

View ViewOf(const LightBake& bake, uint32_t point) {
  const OpenView& open = bake.open_views[bake.open_view_of[point]];
  View view{.ground = static_cast<double>(open.ground)};
  for (const SkyPart& part : open.sky) view.sky += static_cast<double>(part.w) / std::numbers::pi;
  for (size_t i = bake.first_factor[point]; i < bake.first_factor[point + 1]; ++i) {
    view.surfaces += static_cast<double>(bake.factors[i].w);
  }
  return view;
}

// The three corners of the leaf that holds a place of a side of a triangle.
std::array<uint32_t, 3> PointsAt(const LightBake& bake, uint32_t side, float u, float v) {
  const uint32_t leaf =
      bake.leaves.Find(bake.patches.FaceOf(side), bake.patches.At(side / 2, u, v));
  return bake.leaves.leaves().at(leaf).points;
}

TEST(LightBake, OfAnUnobstructedWallIsExactlyOneHalf) {
  const TracedScene traced(MakePaperTarget({}));
  const LightBake bake = Bake(traced);
  for (uint32_t t = 0; t < traced.opaque().size(); ++t) {
    for (const uint32_t point : PointsAt(bake, 2 * t, 0.3f, 0.3f)) {
      const View view = ViewOf(bake, point);
      EXPECT_NEAR(view.sky, 0.5, kBakeRounding);
      EXPECT_NEAR(view.ground, 0.5, kBakeRounding);
    }
  }
  EXPECT_TRUE(bake.factors.empty());
}

TEST(LightBake, OfATiltedRoofFollowsItsTilt) {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = {Polygon({{-1, 0, 1}, {1, 0, 1}, {1, 1, 0}, {-1, 1, 0}}, 0)};
  const LightBake bake = Bake(TracedScene(scene));
  const double n_y = std::sqrt(0.5);
  const View upper = ViewOf(bake, PointsAt(bake, 0, 0.2f, 0.2f)[0]);
  EXPECT_NEAR(upper.sky, 0.5 * (1.0 + n_y), kBakeRounding);
  EXPECT_NEAR(upper.ground, 0.5 * (1.0 - n_y), kBakeRounding);
  EXPECT_NEAR(ViewOf(bake, PointsAt(bake, 1, 0.2f, 0.2f)[0]).sky, 0.5 * (1.0 - n_y),
              kBakeRounding);  // Its underside.
}

TEST(LightBake, BehindAPlateLosesThePlatesViewFactor) {
  for (const double distance : {0.5, 1.0, 3.0}) {
    Scene scene;
    scene.materials = {Grey(0.5f)};
    // The wall is a small piece about the origin; the plate stands before it, off-centre.
    scene.meshes = {UprightRectangle(-1e-4f, -1e-4f, 1e-4f, 1e-4f, 0.0f, 0),
                    UprightRectangle(-0.5f, -0.3f, 0.5f, 0.7f, static_cast<float>(distance), 0)};
    const LightBake bake = Bake(TracedScene(scene));
    const double above = 2.0 * CornerViewFactor(0.5, 0.7, distance);
    const double below = 2.0 * CornerViewFactor(0.5, 0.3, distance);
    const View view = ViewOf(bake, PointsAt(bake, 0, 0.3f, 0.3f)[0]);
    EXPECT_NEAR(view.sky, 0.5 - above, kBakingError) << distance;
    EXPECT_NEAR(view.ground, 0.5 - below, kBakingError) << distance;
    // What the plate hides is seen as the plate's back: the form factors are what is left.
    EXPECT_NEAR(view.surfaces, above + below, kBakingError) << distance;
  }
}

// A wall of two triangles under a plate, seen from between them: the grid is as fine as it must be,
// and what is known at its nodes is interpolated to the right places.
TEST(LightBake, IsInterpolatedBetweenNodes) {
  Scene scene;
  scene.materials = {Grey(1.0f)};
  scene.meshes = {UprightRectangle(-1.0f, -1.0f, 1.0f, 1.0f, 0.0f, 0),
                  UprightRectangle(-0.5f, -0.5f, 0.5f, 0.5f, 1.0f, 0)};
  const RayGrid rays(CameraModel::Pinhole(160, 160, 120.0));
  const double z = 0.6;
  const cv::Mat image =
      RayCaster(scene, {.bounces = 0})
          .Render(rays, FacingTheWall({0, 0, z}), OnlySky(1e4, 0.0), {}, RandomStream(1));
  for (int v = 0; v < 160; v += 3) {
    for (int u = 0; u < 160; u += 3) {
      const double x = (u - 79.5) / 120.0 * z;
      const double y = -(v - 79.5) / 120.0 * z;
      const double sky =
          0.5 - CornerViewFactor(0.5 - x, 0.5 - y, 1.0) - CornerViewFactor(0.5 + x, 0.5 - y, 1.0);
      // Leaves are halved where they err by 3 % at the middle of their hypotenuse, small ones where
      // they err by more.
      EXPECT_NEAR(image.at<float>(v, u) * std::numbers::pi / 1e4, sky, kBakingError + 0.05 * sky);
    }
  }
}

TEST(LightBake, OfAFacadeIsNothingInsideAndAllOfTheHemisphereElsewhere) {
  const TracedScene traced(MakeFacade({.window = {.setback_m = 0.1, .glass = false}}));
  const LightBake bake = Bake(traced);
  for (uint32_t t = 0; t < traced.opaque().size(); ++t) {
    EXPECT_EQ(bake.leaves.Find(bake.patches.FaceOf(2 * t + 1), {0.5f, 0.5f}), LightLeaves::kNone);
  }
  for (const LightLeaves::Leaf& leaf : bake.leaves.leaves()) {
    const double n_y = static_cast<double>(bake.patches.PatchOfFace(leaf.face).n_W.y);
    for (const uint32_t point : leaf.points) {
      const View view = ViewOf(bake, point);
      EXPECT_LE(view.sky, 0.5 * (1.0 + n_y) + kBakeRounding);
      EXPECT_LE(view.ground, 0.5 * (1.0 - n_y) + kBakeRounding);
      EXPECT_NEAR(view.all(), 1.0, kBakingError);
    }
  }
}

}  // namespace
}  // namespace fenestra
