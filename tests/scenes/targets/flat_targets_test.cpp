#include "scenes/targets/flat_targets.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/io/input_error.h"
#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

double FrontArea(const Mesh& mesh) {
  return AreaInPlane(mesh, 0.0);
}

// Areas are sums of some thousand products of single-precision coordinates below 10 m.
constexpr double kAreaTolerance = 1e-5;

TEST(PaperTarget, BorderAndWallDivideThePlaneExactly) {
  const Scene scene = MakePaperTarget({.width_m = 1.3, .height_m = 0.9, .border_m = 0.07});
  EXPECT_NO_THROW(Validate(scene));
  const double border = 1.3 * 0.9 - (1.3 - 0.14) * (0.9 - 0.14);
  EXPECT_NEAR(FrontArea(*Find(scene, "border")), border, kAreaTolerance);
  EXPECT_NEAR(FrontArea(*Find(scene, "wall")), 12.0 * 8.0 - border, kAreaTolerance);
  ASSERT_TRUE(scene.target);
  EXPECT_EQ(scene.target->Centroid_W(), Eigen::Vector3d::Zero());
  EXPECT_EQ(scene.target->width_m, 1.3);
}

TEST(PaperTarget, WithoutTargetIsABareWall) {
  const Scene scene = MakePaperTarget({.with_target = false});
  EXPECT_FALSE(scene.target);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_NEAR(FrontArea(scene.meshes[0]), 96.0, kAreaTolerance);
}

TEST(PaperTarget, AllFaultsAreReportedAtOnce) {
  try {
    MakePaperTarget({.width_m = 13.0,
                     .border_m = -0.1,
                     .wall_reflectance = 1.2,
                     .frame_reflectance = std::numeric_limits<double>::quiet_NaN()});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 4u) << error.what();
  }
}

}  // namespace
}  // namespace fenestra
