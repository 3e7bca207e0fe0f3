#include "scenes/facade/facade.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

double FrontArea(const Mesh& mesh) {
  return AreaInPlane(mesh, 0.0);
}

// Areas are sums of some thousand products of single-precision coordinates below 10 m.
constexpr double kAreaTolerance = 1e-5;

TEST(Facade, WallHasATrueOpening) {
  const Scene scene = MakeFacade({.window = {.setback_m = 0.1}});
  EXPECT_NO_THROW(Validate(scene));
  EXPECT_NEAR(FrontArea(*Find(scene, "wall")), 12.0 * 8.0 - 1.0, kAreaTolerance);
  EXPECT_EQ(FrontArea(*Find(scene, "frame")), 0.0);  // It stands 0.1 m behind.
}

TEST(Facade, AFlushFrameFillsTheOpeningsEdge) {
  const Scene scene = MakeFacade({});
  EXPECT_NEAR(FrontArea(*Find(scene, "frame")), 1.0 - 0.8 * 0.8, kAreaTolerance);
}

TEST(Facade, TheTargetIsTheFramesFrontOuterRectangle) {
  const Scene scene = MakeFacade({.window = {.width_m = 1.2, .setback_m = 0.15}});
  ASSERT_TRUE(scene.target);
  EXPECT_EQ(scene.target->Centroid_W(), Eigen::Vector3d(0.0, 0.0, -0.15));
  const Mesh& frame = *Find(scene, "frame");
  const auto [back, front] =
      std::ranges::minmax(frame.positions_W, {}, [](const glm::vec3& p) { return p.z; });
  EXPECT_EQ(front.z, -0.15f);
  EXPECT_EQ(back.z, -0.21f);  // A frame is 0.06 m deep.
  const auto right =
      std::ranges::max(frame.positions_W, {}, [](const glm::vec3& p) { return p.x; });
  EXPECT_EQ(right.x, 0.6f);
}

TEST(Facade, GlassAndTargetCanBeLeftOut) {
  EXPECT_NE(Find(MakeFacade({}), "pane"), nullptr);
  EXPECT_EQ(Find(MakeFacade({.window = {.glass = false}}), "pane"), nullptr);
  const Scene bare = MakeFacade({.with_target = false});
  EXPECT_FALSE(bare.target);
  EXPECT_EQ(bare.meshes.size(), 1u);
  EXPECT_NEAR(FrontArea(bare.meshes[0]), 96.0, kAreaTolerance);
}

}  // namespace
}  // namespace fenestra
