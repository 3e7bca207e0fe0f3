#include "vision/rgbd/paper/diagonals.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/pose.h"
#include "core/random/random_stream.h"

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

constexpr double kInPlane_m = 0.02;
constexpr double kAcross_m = 0.004;
constexpr int kDraws = 500;

const Plane kPlane{.normal_K = Eigen::Vector3d(0.0, 0.6, -0.8), .offset_m = -1.6};

// A square of 1 m on the plane, 2 m away, with errors.
FourVertices SquareWithErrors(const RandomStream& stream) {
  std::vector<float> normals(12);
  stream.FillNormals(normals);
  const Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d down(0.0, 0.8, 0.6);
  FourVertices vertices;
  for (size_t i = 0; i < 4; ++i) {
    const double x = i == 1 || i == 2 ? 0.5 : -0.5;
    const double y = i >= 2 ? 0.5 : -0.5;
    const auto error = [&](size_t k) { return static_cast<double>(normals[3 * i + k]); };
    vertices[i] = Eigen::Vector3d(0.0, 0.0, 2.0) + (x + kInPlane_m * error(0)) * right +
                  (y + kInPlane_m * error(1)) * down + kAcross_m * error(2) * kPlane.normal_K;
  }
  return vertices;
}

double MeanNormalisedSquare(const VertexErrors& errors) {
  double sum = 0.0;
  for (uint64_t i = 0; i < kDraws; ++i) {
    const FourVertices vertices = SquareWithErrors(RandomStream(3).Child("draw", i));
    const Eigen::Vector3d error = CrossDiagonals(vertices)->p_CO - Eigen::Vector3d(0.0, 0.0, 2.0);
    sum += error.dot(CrossingCovariance(vertices, kPlane, errors).inverse() * error);
  }
  return sum / kDraws;
}

TEST(CrossingCovariance, IsWhatTheCrossingErrsBy) {
  // Known well beforehand: χ² of 3 in the mean of 500, whose standard deviation is √(6 / 500);
  // four of them are 1 in 16,000.
  const double limit = 4.0 * std::sqrt(6.0 / kDraws);
  const VertexErrors known{
      .expected_m = kInPlane_m, .expected_weight = 1000.0, .across_m = kAcross_m, .common_m = 0.0};
  EXPECT_NEAR(MeanNormalisedSquare(known), 3.0, limit);
  VertexErrors halved = known;
  halved.expected_m *= std::sqrt(0.5);
  EXPECT_GT(MeanNormalisedSquare(halved), 3.0 + limit);
}

TEST(CrossingCovariance, LearnsFromTheVerticesThemselves) {
  // Nothing is known beforehand: the variance is the mean of three residuals, right on average.
  double sum = 0.0;
  for (uint64_t i = 0; i < kDraws; ++i) {
    const FourVertices vertices = SquareWithErrors(RandomStream(4).Child("draw", i));
    sum += CrossingCovariance(vertices, kPlane, {0.0, 0.0, 0.0, 0.0}).trace();
  }
  // Two directions of σ² / 2; the mean of 3 squares has a relative standard deviation of √(2/3).
  const double expected = kInPlane_m * kInPlane_m;
  EXPECT_NEAR(sum / kDraws / expected, 1.0, 4.0 * std::sqrt(2.0 / 3.0 / kDraws));
}

TEST(CrossingCovariance, CommonErrorsAreNotAveraged) {
  const Eigen::Matrix3d covariance =
      CrossingCovariance(SquareWithErrors(RandomStream(1)), kPlane, {0.0, 1e9, 0.004, 0.003});
  const Eigen::Vector3d& n = kPlane.normal_K;
  EXPECT_NEAR(n.dot(covariance * n), 0.25 * 0.004 * 0.004 + 0.003 * 0.003, 1e-12);
}

}  // namespace
}  // namespace fenestra
