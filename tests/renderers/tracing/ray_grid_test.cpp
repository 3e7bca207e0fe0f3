#include "renderers/tracing/ray_grid.h"

#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

TEST(RayGrid, CornersAreTheCamerasRays) {
  const CameraModel camera = DistortedCamera();
  const RayGrid rays(camera);
  for (const auto& [column, row] : {std::pair{0, 0}, {376, 0}, {188, 120}, {376, 240}}) {
    const Eigen::Vector3d ray = *camera.UnprojectRay({column - 0.5, row - 0.5});
    // One rounding to single precision, of numbers below 1.
    EXPECT_LT((rays.Corner(column, row).cast<double>() - ray.head<2>()).norm(), 1e-7);
  }
}

TEST(RayGrid, InterpolationInsideAPixelIsGoodToAFewTenthsOfAMillipixel) {
  const CameraModel camera = DistortedCamera();
  const RayGrid rays(camera);
  for (int row = 0; row < rays.height_px(); row += 17) {
    for (int column = 0; column < rays.width_px(); column += 13) {
      const Eigen::Vector2f centre =
          0.25f * (rays.Corner(column, row) + rays.Corner(column + 1, row) +
                   rays.Corner(column, row + 1) + rays.Corner(column + 1, row + 1));
      const auto pixel = camera.Project(centre.homogeneous().cast<double>());
      // A pixel's middle is off by (∂²/∂u² + ∂²/∂v²)/8 of the undistorted point: with x' = x + k1 x
      // r² that is |k1| r per pixel of 1/f, at r = 0.65 0.065/333 = 2e-4 px. Rounding adds 2e-5 px.
      EXPECT_LT((*pixel - Eigen::Vector2d(column, row)).norm(), 2.5e-4);
    }
  }
}

TEST(RayGrid, RefusesACameraWhoseImageLeavesTheLensModelsDomain) {
  CameraParameters parameters = DistortedCamera().parameters();
  parameters.distortion.k1 = -1.5;
  EXPECT_THROW(RayGrid{CameraModel(parameters)}, InputError);
}

}  // namespace
}  // namespace fenestra
