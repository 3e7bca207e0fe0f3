#include "renderers/sky_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderers/ray_caster.h"
#include "scenes/facade.h"
#include "scenes/paper_target.h"
#include "scenes/solid_lattice.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

// The error that the header states.
constexpr double kBakingError = 0.002;

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

TEST(SkyView, OfAnUnobstructedWallIsExactlyOneHalf) {
  const TracedScene traced(MakePaperTarget({}));
  const auto views = BakeSkyViews(traced);
  for (size_t t = 0; t < traced.opaque().size(); ++t) {
    for (const SkyView& view : views[2 * t]) {
      EXPECT_EQ(view.sky, 0.5f);
      EXPECT_EQ(view.ground, 0.5f);
    }
  }
}

TEST(SkyView, OfATiltedRoofFollowsItsTilt) {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = {Polygon({{-1, 0, 1}, {1, 0, 1}, {1, 1, 0}, {-1, 1, 0}}, 0)};
  const auto views = BakeSkyViews(TracedScene(scene));
  const float n_y = std::sqrt(0.5f);
  EXPECT_FLOAT_EQ(views[0][0].sky, 0.5f * (1.0f + n_y));
  EXPECT_FLOAT_EQ(views[0][0].ground, 0.5f * (1.0f - n_y));
  EXPECT_FLOAT_EQ(views[1][0].sky, 0.5f * (1.0f - n_y));  // Its underside.
}

TEST(SkyView, BehindAPlateLosesThePlatesViewFactor) {
  for (const double distance : {0.5, 1.0, 3.0}) {
    Scene scene;
    scene.materials = {Grey(0.5f)};
    // The wall's first corner is the origin; the plate stands before it, off-centre.
    scene.meshes = {UprightRectangle(0, 0, 0.1f, 0.1f, 0.0f, 0),
                    UprightRectangle(-0.5f, -0.3f, 0.5f, 0.7f, static_cast<float>(distance), 0)};
    const auto views = BakeSkyViews(TracedScene(scene));
    const double above = 2.0 * CornerViewFactor(0.5, 0.7, distance);
    const double below = 2.0 * CornerViewFactor(0.5, 0.3, distance);
    EXPECT_NEAR(views[0][0].sky, 0.5 - above, kBakingError) << distance;
    EXPECT_NEAR(views[0][0].ground, 0.5 - below, kBakingError) << distance;
  }
}

// A wall of 0.1 m cells under a plate, seen from between them: what is baked at the cells' corners
// is interpolated to the right places.
TEST(SkyView, IsInterpolatedBetweenCorners) {
  const std::vector<float> breaks = GradedBreaks({-1.0, 1.0}, [](double) { return 0.13; });
  SolidLattice lattice({breaks, breaks, {-1.0f, 0.0f}});
  lattice.Fill({{-1, -1, -1}, {1, 1, 0}}, 1);
  Scene scene;
  scene.materials = {Grey(1.0f)};
  scene.meshes = {lattice.Surface(1, SolidLattice::Faces::kFrontOfLattice, "wall", 0),
                  UprightRectangle(-0.5f, -0.5f, 0.5f, 0.5f, 1.0f, 0)};
  const RayGrid rays(CameraModel::Pinhole(160, 160, 120.0));
  const double z = 0.6;
  const cv::Mat image = RayCaster(scene).Render(rays, FacingTheWall({0, 0, z}), OnlySky(1e4, 0.0),
                                                {}, RandomStream(1));
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

TEST(SkyView, OfAFacadeIsNothingInsideAndNowhereMoreThanTheUnobstructedOne) {
  const TracedScene traced(MakeFacade({.window = {.setback_m = 0.1}}));
  const auto views = BakeSkyViews(traced);
  for (size_t t = 0; t < traced.opaque().size(); ++t) {
    const float n_y = traced.opaque().normals_W[t].y;
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(views[2 * t + 1][k].sky + views[2 * t + 1][k].ground, 0.0f);
      EXPECT_LE(views[2 * t][k].sky, 0.5f * (1.0f + n_y) + 1e-6f);
      EXPECT_LE(views[2 * t][k].ground, 0.5f * (1.0f - n_y) + 1e-6f);
    }
  }
}

}  // namespace
}  // namespace fenestra
