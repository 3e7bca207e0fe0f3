#include "vision/stereo/paper/window_rectangle.h"

#include <gtest/gtest.h>

#include "core/geometry/pose.h"
#include "core/random/random_stream.h"

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

const DisparityPlane kPlane{.a = 0.01, .b = -0.005, .c = 60.0};
const Eigen::Vector2d kCentre(200.0, 150.0);
constexpr double kTolerance_px = 0.75;
constexpr double kNoise_px = 0.05;
constexpr double kBias_px = 0.06;
constexpr int kDraws = 400;
// The sum of 400 squares has a relative standard deviation of √(2 / 400): four of them are 1 in
// 16,000 on either side.
constexpr double kLimit = 4.0 * 0.0707;

// An upright side of a frame: its matches have noise of their own and a bias in common.
MatchedPatch SideWithErrors(int left_px, const RandomStream& stream) {
  MatchedPatch patch{
      .box = cv::Rect(left_px, 60, 20, 180), .area_px = 20 * 180, .hull = {}, .samples = {}};
  std::vector<float> normals(1 + 5 * 45);
  stream.FillNormals(normals);
  size_t next = 1;
  for (int v = 60; v < 240; v += 4) {
    for (int u = left_px; u < left_px + 20; u += 4) {
      const double d = kPlane.At({u, v}) + kBias_px * static_cast<double>(normals[0]) +
                       kNoise_px * static_cast<double>(normals[next++]);
      patch.samples.push_back(
          {static_cast<float>(u), static_cast<float>(v), static_cast<float>(d)});
    }
  }
  return patch;
}

// Mean over many draws of the squared error of the fitted plane's disparity, over its variance.
double NormalisedSquare(const MatchErrors& errors) {
  double sum = 0.0;
  for (uint64_t i = 0; i < kDraws; ++i) {
    const RandomStream stream = RandomStream(7).Child("draw", i);
    const MatchedPatch left = SideWithErrors(100, stream.Child("left"));
    const MatchedPatch right = SideWithErrors(280, stream.Child("right"));
    std::vector<DisparitySample> samples = left.samples;
    samples.insert(samples.end(), right.samples.begin(), right.samples.end());
    const auto fit = FitDisparityPlane(samples, kTolerance_px);
    const auto variance_px2 =
        DisparityVariance({&left, &right}, fit->plane, kTolerance_px, kCentre, errors);
    const double error_px = fit->plane.At(kCentre) - kPlane.At(kCentre);
    sum += error_px * error_px / *variance_px2;
  }
  return sum / kDraws;
}

TEST(DisparityVariance, IsWhatThePlaneErrsBy) {
  // Windows of 4 px: one to each sample, so that all are independent.
  const MatchErrors honest{.window_px = 4.0, .subpixel_bias_px = kBias_px, .contour_px = 1.0};
  EXPECT_NEAR(NormalisedSquare(honest), 1.0, kLimit);
  MatchErrors blind = honest;
  blind.subpixel_bias_px = 0.5 * kBias_px;
  EXPECT_GT(NormalisedSquare(blind), 1.0 + kLimit);
}

TEST(DisparityVariance, MatchesWithinOneWindowCountOnce) {
  const MatchedPatch left = SideWithErrors(100, RandomStream(1));
  const MatchedPatch right = SideWithErrors(280, RandomStream(2));
  const auto variance = [&](double window_px) {
    return *DisparityVariance({&left, &right}, kPlane, kTolerance_px, kCentre,
                              {.window_px = window_px, .subpixel_bias_px = 0.0, .contour_px = 1.0});
  };
  EXPECT_NEAR(variance(12.0) / variance(4.0), 9.0, 1e-9);
}

TEST(DisparityVariance, NeedsAPlane) {
  const MatchedPatch none{.box = {}, .area_px = 0, .hull = {}, .samples = {}};
  EXPECT_FALSE(DisparityVariance({&none}, kPlane, kTolerance_px, kCentre, {15.0, 0.05, 1.0}));
}

TEST(CentreCovariance, OfAFacedPlaneIsTextbook) {
  const RectifiedCamera camera{.f_px = 600.0, .cx_px = 200.0, .cy_px = 150.0, .baseline_m = 0.35};
  const DisparityPlane faced{.a = 0.0, .b = 0.0, .c = 70.0};  // 3 m.
  const Eigen::Matrix3d covariance =
      CentreCovariance(kCentre, faced, 0.01, camera,
                       {.window_px = 15.0, .subpixel_bias_px = 0.0, .contour_px = 2.0});
  // σ_x = z σ_u / f with σ_u = 2 / √2 px;  σ_z = z² σ_d / (f B) with σ_d = 0.1 px.
  const double sigma_x = 3.0 * std::sqrt(2.0) / 600.0;
  const double sigma_z = 9.0 * 0.1 / (600.0 * 0.35);
  const Eigen::Vector3d expected(sigma_x * sigma_x, sigma_x * sigma_x, sigma_z * sigma_z);
  EXPECT_LT((covariance - Eigen::Matrix3d(expected.asDiagonal())).norm(), 1e-12);
}

}  // namespace
}  // namespace fenestra
