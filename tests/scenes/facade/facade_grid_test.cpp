#include <gtest/gtest.h>

#include <algorithm>

#include "core/io/input_error.h"
#include "tests/scenes/facade/facade_examples.h"
#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

FacadeOptions ThreeByTwo() {
  FacadeOptions o;
  o.window.setback_m = 0.1;
  o.grid = {
      .windows_left = 1, .windows_right = 1, .windows_above = 1, .gap_x_m = 0.7, .gap_y_m = 1.1};
  return o;
}

bool HasWindowAt(const Scene& scene, const Eigen::Vector3d& p_W) {
  // Sums of sizes of some metres.
  return std::ranges::any_of(scene.other_windows, [&](const TargetWindow& window) {
    return (window.Centroid_W() - p_W).norm() < 1e-12;
  });
}

TEST(FacadeGrid, OtherWindowsStandAroundTheTarget) {
  const Scene scene = MakeFacade(ThreeByTwo());
  ASSERT_EQ(scene.other_windows.size(), 5u);
  EXPECT_EQ(scene.target->Centroid_W(), Eigen::Vector3d(0.0, 0.0, -0.1));
  for (const double x : {-1.7, 0.0, 1.7}) {
    for (const double y : {0.0, 2.1}) {
      EXPECT_EQ(HasWindowAt(scene, {x, y, -0.1}), x != 0.0 || y != 0.0) << x << ", " << y;
    }
  }
  EXPECT_NEAR(AreaInPlane(*Find(scene, "wall"), 0.0), 12.0 * 8.0 - 6.0, 1e-4);
}

TEST(FacadeGrid, OnlyTheTargetIsDarkFramed) {
  const Scene scene = MakeFacade(ThreeByTwo());
  EXPECT_FLOAT_EQ(scene.materials[Find(scene, "frame")->material].reflectance_rgb.g, 0.05f);
  EXPECT_FLOAT_EQ(scene.materials[Find(scene, "other frame")->material].reflectance_rgb.g, 0.70f);
  for (const glm::vec3& p : Find(scene, "frame")->positions_W) {
    EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 0.5f);
  }
}

TEST(FacadeGrid, WithoutTargetKeepsTheOtherWindows) {
  FacadeOptions o = ThreeByTwo();
  o.with_target = false;
  const Scene scene = MakeFacade(o);
  EXPECT_FALSE(scene.target);
  EXPECT_EQ(scene.other_windows.size(), 5u);
  EXPECT_EQ(Find(scene, "frame"), nullptr);
  EXPECT_NEAR(AreaInPlane(*Find(scene, "wall"), 0.0), 12.0 * 8.0 - 5.0, 1e-4);
  o.grid.other_windows_share = 0.0;
  EXPECT_EQ(MakeFacade(o).meshes.size(), 1u);
}

// Each place draws for itself: the grid may grow without changing what was there.
TEST(FacadeGrid, APlaceHasItsWindowWhereverTheGridEnds) {
  FacadeOptions small = ThreeByTwo();
  small.grid.other_windows_share = 0.5;
  FacadeOptions large = small;
  large.grid.windows_right = 2;
  large.grid.windows_below = 1;
  bool any_missing = false;
  bool any_present = false;
  for (const double seed : {1.0, 2.0, 3.0}) {
    small.seed = large.seed = seed;
    const Scene few = MakeFacade(small);
    const Scene many = MakeFacade(large);
    for (const double x : {-1.7, 0.0, 1.7}) {
      for (const double y : {0.0, 2.1}) {
        EXPECT_EQ(HasWindowAt(few, {x, y, -0.1}), HasWindowAt(many, {x, y, -0.1}));
        (HasWindowAt(few, {x, y, -0.1}) ? any_present : any_missing) = true;
      }
    }
  }
  EXPECT_TRUE(any_missing && any_present);  // 15 places with one chance in two: 6e-5.
}

TEST(FacadeGrid, ThatDoesNotFitOnTheWallIsAnError) {
  FacadeOptions o = ThreeByTwo();
  o.wall.width_m = 2.0 * (0.5 + 1.7 + 0.1) + 0.01;
  EXPECT_NO_THROW(MakeFacade(o));
  o.wall.width_m -= 0.02;
  EXPECT_THROW(MakeFacade(o), InputError);
}

}  // namespace
}  // namespace fenestra
