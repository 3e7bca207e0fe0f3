#include "renderers/light/light_bake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderers/ray_caster.h"
#include "scenes/facade/facade.h"
#include "scenes/mesh/solid_lattice.h"
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

// What a corner of a side sees, as parts of what a horizontal surface sees of all sky.
struct View {
  double sky;
  double ground;
};

View ViewOf(const LightBake& bake, size_t side, size_t corner) {
  const OpenView& view = bake.open_views[bake.open_view_of[bake.corners[side][corner]]];
  double sky = 0.0;
  for (const float s : view.sky) sky += static_cast<double>(s) / std::numbers::pi;
  return {sky, static_cast<double>(view.ground)};
}

TEST(LightBake, OfAnUnobstructedWallIsExactlyOneHalf) {
  const TracedScene traced(MakePaperTarget({}));
  const LightBake bake = Bake(traced);
  for (size_t t = 0; t < traced.opaque().size(); ++t) {
    for (const size_t k : {0u, 1u, 2u}) {
      const View view = ViewOf(bake, 2 * t, k);
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
  EXPECT_NEAR(ViewOf(bake, 0, 0).sky, 0.5 * (1.0 + n_y), kBakeRounding);
  EXPECT_NEAR(ViewOf(bake, 0, 0).ground, 0.5 * (1.0 - n_y), kBakeRounding);
  EXPECT_NEAR(ViewOf(bake, 1, 0).sky, 0.5 * (1.0 - n_y), kBakeRounding);  // Its underside.
}

TEST(LightBake, BehindAPlateLosesThePlatesViewFactor) {
  for (const double distance : {0.5, 1.0, 3.0}) {
    Scene scene;
    scene.materials = {Grey(0.5f)};
    // The wall's first corner is the origin; the plate stands before it, off-centre.
    scene.meshes = {UprightRectangle(0, 0, 0.1f, 0.1f, 0.0f, 0),
                    UprightRectangle(-0.5f, -0.3f, 0.5f, 0.7f, static_cast<float>(distance), 0)};
    const LightBake bake = Bake(TracedScene(scene));
    const double above = 2.0 * CornerViewFactor(0.5, 0.7, distance);
    const double below = 2.0 * CornerViewFactor(0.5, 0.3, distance);
    EXPECT_NEAR(ViewOf(bake, 0, 0).sky, 0.5 - above, kBakingError) << distance;
    EXPECT_NEAR(ViewOf(bake, 0, 0).ground, 0.5 - below, kBakingError) << distance;
    // What the plate hides is seen as the plate's back: the form factors are what is left.
    double plate = 0.0;
    for (size_t i = bake.first_factor[bake.corners[0][0]];
         i < bake.first_factor[bake.corners[0][0] + 1]; ++i) {
      plate += static_cast<double>(bake.factors[i].w);
    }
    EXPECT_NEAR(plate, above + below, kBakingError) << distance;
  }
}

// A wall of 0.1 m cells under a plate, seen from between them: what is baked at the cells' corners
// is interpolated to the right places.
TEST(LightBake, IsInterpolatedBetweenCorners) {
  const std::vector<float> breaks = GradedBreaks({-1.0, 1.0}, [](double) { return 0.13; });
  SolidLattice lattice({breaks, breaks, {-1.0f, 0.0f}});
  lattice.Fill({{-1, -1, -1}, {1, 1, 0}}, 1);
  Scene scene;
  scene.materials = {Grey(1.0f)};
  scene.meshes = {lattice.Surface(1, SolidLattice::Faces::kFrontOfLattice, "wall", 0),
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
      // Linear interpolation errs by h²/8 times the curvature, at most about 1/m²: 0.002.
      EXPECT_NEAR(image.at<float>(v, u) * std::numbers::pi / 1e4, sky, kBakingError + 0.002);
    }
  }
}

TEST(LightBake, OfAFacadeIsNothingInsideAndAllOfTheHemisphereElsewhere) {
  const TracedScene traced(MakeFacade({.window = {.setback_m = 0.1, .glass = false}}));
  const LightBake bake = Bake(traced);
  for (size_t t = 0; t < traced.opaque().size(); ++t) {
    EXPECT_EQ(bake.corners[2 * t + 1][0], LightBake::kNoPoint);
    const double n_y = static_cast<double>(traced.opaque().normals_W[t].y);
    for (const size_t k : {0u, 1u, 2u}) {
      const View view = ViewOf(bake, 2 * t, k);
      EXPECT_LE(view.sky, 0.5 * (1.0 + n_y) + kBakeRounding);
      EXPECT_LE(view.ground, 0.5 * (1.0 - n_y) + kBakeRounding);
      double all = view.sky + view.ground;
      const uint32_t point = bake.corners[2 * t][k];
      for (size_t i = bake.first_factor[point]; i < bake.first_factor[point + 1]; ++i) {
        all += static_cast<double>(bake.factors[i].w);
      }
      EXPECT_NEAR(all, 1.0, kBakingError);
    }
  }
}

}  // namespace
}  // namespace fenestra
