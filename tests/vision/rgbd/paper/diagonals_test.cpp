#include "vision/rgbd/paper/diagonals.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/geometry/pose.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

FourVertices Parallelogram(const Vector3d& center, const Vector3d& a, const Vector3d& b) {
  return {center - a - b, center + a - b, center + a + b, center - a + b};
}

TEST(Diagonals, CrossAtTheCentreOfEveryParallelogram) {
  // Small integers and halves are exact in every product, so the result is.
  const Vector3d center(1.0, -2.0, 4.0);
  const auto crossing = CrossDiagonals(Parallelogram(center, {1.0, 0.5, 0.25}, {0.0, 1.0, -0.5}));
  ASSERT_TRUE(crossing);
  EXPECT_LT((crossing->p_CO - center).norm(), 1e-15 * 16);  // Some roundings of numbers up to 4.
  EXPECT_LT(crossing->gap_m, 1e-15 * 16);
}

TEST(Diagonals, CrossingIsThatOfTheLinesAndNotTheMeanOfTheVertices) {
  // A trapezium: its diagonals meet at (0, 2/3), its vertices' mean is (0, 1).
  const FourVertices trapezium = {
      Vector3d(-1.0, 0.0, 5.0), {1.0, 0.0, 5.0}, {2.0, 2.0, 5.0}, {-2.0, 2.0, 5.0}};
  const auto crossing = CrossDiagonals(trapezium);
  ASSERT_TRUE(crossing);
  EXPECT_LT((crossing->p_CO - Vector3d(0.0, 2.0 / 3.0, 5.0)).norm(), 1e-14);
}

TEST(Diagonals, RelabellingAndReversingTheOutlineChangesNothing) {
  const FourVertices bent = {
      Vector3d(-0.4, -0.5, 2.0), {0.6, -0.45, 2.1}, {0.5, 0.55, 2.05}, {-0.52, 0.48, 1.9}};
  const auto expected = CrossDiagonals(bent);
  ASSERT_TRUE(expected);
  EXPECT_GT(expected->gap_m, 0.01);  // Not planar, or the test would be weaker than its name.
  FourVertices turned = bent;
  for (int i = 0; i < 8; ++i) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    if (i == 4) std::reverse(turned.begin(), turned.end());
    const auto crossing = CrossDiagonals(turned);
    ASSERT_TRUE(crossing);
    EXPECT_LT((crossing->p_CO - expected->p_CO).norm(), 1e-14);
    EXPECT_NEAR(crossing->gap_m, expected->gap_m, 1e-14);
  }
}

TEST(Diagonals, OfSkewLinesTheMidpointOfTheShortestSegmentIsTaken) {
  // Along x at z = 1 and along y at z = 1.2: nearest at (0, 0), 0.2 apart.
  const FourVertices skew = {
      Vector3d(-1.0, 0.0, 1.0), {0.0, -1.0, 1.2}, {1.0, 0.0, 1.0}, {0.0, 1.0, 1.2}};
  const auto crossing = CrossDiagonals(skew);
  ASSERT_TRUE(crossing);
  EXPECT_LT((crossing->p_CO - Vector3d(0.0, 0.0, 1.1)).norm(), 1e-15);
  EXPECT_NEAR(crossing->gap_m, 0.2, 1e-15);
}

TEST(Diagonals, AreEquivariantUnderRigidMotion) {
  const FourVertices p_AV = {
      Vector3d(-0.4, -0.5, 2.0), {0.6, -0.45, 2.1}, {0.5, 0.55, 2.05}, {-0.52, 0.48, 1.9}};
  const Pose X_BA(RotationFromVector({0.3, -0.2, 0.9}), {0.5, 1.5, -0.7});
  FourVertices p_BV;
  for (size_t i = 0; i < 4; ++i) p_BV[i] = X_BA * p_AV[i];
  EXPECT_LT((CrossDiagonals(p_BV)->p_CO - X_BA * CrossDiagonals(p_AV)->p_CO).norm(), 1e-13);
}

TEST(Diagonals, ThatDoNotCrossInsideGiveNothing) {
  const FourVertices dart = {
      Vector3d(0.0, 0.0, 1.0), {1.0, -1.0, 1.0}, {0.5, 0.0, 1.0}, {1.0, 1.0, 1.0}};
  EXPECT_FALSE(CrossDiagonals(dart));
  const FourVertices flat = {
      Vector3d(0.0, 0.0, 1.0), {1.0, 0.0, 1.0}, {2.0, 0.0, 1.0}, {3.0, 0.0, 1.0}};
  EXPECT_FALSE(CrossDiagonals(flat));
  const Vector3d point(0.1, 0.2, 1.0);
  EXPECT_FALSE(CrossDiagonals({point, point, point, point}));
}

}  // namespace
}  // namespace fenestra
