#include "vision/stereo/paper/window_rectangle.h"

#include <gtest/gtest.h>

#include "core/geometry/pose.h"

namespace fenestra {
namespace {

TEST(WindowRectangle, ProjectedRectangleGivesItsOwnGeometry) {
  const RectifiedCamera camera{.f_px = 600.0, .cx_px = 300.0, .cy_px = 200.0, .baseline_m = 0.4};
  const Pose X_FO(RotationFromVector({0.2, -0.4, 0.1}) *
                      Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal().toDenseMatrix(),
                  {0.3, -0.2, 3.0});
  const Eigen::Vector3d n = X_FO.rotation().col(2);
  const double h = -n.dot(X_FO.translation());  // -n · p = h > 0.
  const DisparityPlane plane{.a = -0.4 * n.x() / h,
                             .b = -0.4 * n.y() / h,
                             .c = -0.4 / h * (600.0 * n.z() - 300.0 * n.x() - 200.0 * n.y())};
  std::array<Eigen::Vector3d, 4> p_FV;
  Quadrilateral corners_px;
  for (size_t i = 0; i < 4; ++i) {
    const double x = i == 1 || i == 2 ? 0.6 : -0.6;
    p_FV[i] = X_FO * Eigen::Vector3d(x, i < 2 ? 0.5 : -0.5, 0.0);
    corners_px[i] = {600.0 * p_FV[i].x() / p_FV[i].z() + 300.0,
                     600.0 * p_FV[i].y() / p_FV[i].z() + 200.0};
  }
  const auto estimate = WindowOnPlane(corners_px, plane, camera);
  ASSERT_TRUE(estimate);
  EXPECT_LT((estimate->p_CO - X_FO.translation()).norm(), 1e-12);
  EXPECT_LT((estimate->normal_C - n).norm(), 1e-12);
  for (size_t i = 0; i < 4; ++i) EXPECT_LT((estimate->p_CV[i] - p_FV[i]).norm(), 1e-12);
  const WindowShape shape = MeasureShape(estimate->p_CV);
  EXPECT_NEAR(shape.width_m, 1.2, 1e-12);
  EXPECT_NEAR(shape.height_m, 1.0, 1e-12);
  EXPECT_NEAR(shape.skew_rad, 0.0, 1e-12);
  EXPECT_NEAR(shape.taper, 0.0, 1e-12);
}

}  // namespace
}  // namespace fenestra
