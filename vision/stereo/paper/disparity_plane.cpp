#include "vision/stereo/paper/disparity_plane.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Both loops converge well before these counts, to a last change below 1e-4 px.
constexpr int kAbsoluteIterations = 12;
constexpr int kTukeyIterations = 8;
// Keeps the weights 1/|r| of least absolute deviations finite. Residuals below the matcher's
// resolution of a sixteenth of a pixel are meaningless.
constexpr double kSmallestResidual_px = 1.0 / 16.0;

// Pixels are centred and scaled so that the normal equations are well conditioned.
struct Centring {
  double u0 = 0.0;
  double v0 = 0.0;
  double scale = 1.0;

  Vector3d Row(const DisparitySample& s) const {
    return {(s.u_px - u0) / scale, (s.v_px - v0) / scale, 1.0};
  }
  // d = row · q as a plane over pixels: (a, b, c) = M q.
  Matrix3d ToPlane() const {
    Matrix3d M;
    M << 1.0 / scale, 0.0, 0.0, 0.0, 1.0 / scale, 0.0, -u0 / scale, -v0 / scale, 1.0;
    return M;
  }
};

Centring Centre(const std::vector<DisparitySample>& samples) {
  Centring centring;
  const double n = static_cast<double>(samples.size());
  for (const DisparitySample& s : samples) {
    centring.u0 += s.u_px / n;
    centring.v0 += s.v_px / n;
  }
  double square = 0.0;
  for (const DisparitySample& s : samples) {
    square += (std::pow(s.u_px - centring.u0, 2) + std::pow(s.v_px - centring.v0, 2)) / n;
  }
  centring.scale = std::max(1.0, std::sqrt(square));
  return centring;
}

// Solves the normal equations with weights w(r) of the residuals of the solution `before`.
template <typename Weight>
std::optional<Vector3d> FitWeighted(const std::vector<DisparitySample>& samples,
                                    const Centring& centring, const Vector3d& before,
                                    const Weight& weight) {
  Matrix3d A = Matrix3d::Zero();
  Vector3d y = Vector3d::Zero();
  for (const DisparitySample& s : samples) {
    const Vector3d row = centring.Row(s);
    const double w = weight(s.disparity_px - row.dot(before));
    A += w * row * row.transpose();
    y += w * s.disparity_px * row;
  }
  const Eigen::LDLT<Matrix3d> solver(A);
  const Vector3d D = solver.vectorD();
  if (!(D.minCoeff() > 1e-6 * D.maxCoeff())) return std::nullopt;
  return Vector3d(solver.solve(y));
}

}  // namespace

std::optional<Vector3d> DisparityPlane::PointAt(const Eigen::Vector2d& pixel,
                                                const RectifiedCamera& camera) const {
  const double d = At(pixel);
  if (!(d > 0.0)) return std::nullopt;
  return camera.DepthFromDisparity(d) * camera.Ray(pixel);
}

Vector3d DisparityPlane::Normal(const RectifiedCamera& camera) const {
  // Along n / h, which points away from the camera as h > 0.
  const Vector3d away(a * camera.f_px, b * camera.f_px, a * camera.cx_px + b * camera.cy_px + c);
  return -away.normalized();
}

std::optional<DisparityPlaneFit> FitDisparityPlane(const std::vector<DisparitySample>& samples,
                                                   double tolerance_px) {
  if (samples.size() < 3) return std::nullopt;
  const Centring centring = Centre(samples);
  const auto one = [](double) { return 1.0; };
  const auto absolute = [](double r) { return 1.0 / std::max(std::abs(r), kSmallestResidual_px); };
  const auto tukey = [tolerance_px](double r) {
    const double t = r / tolerance_px;
    return std::abs(t) < 1.0 ? (1.0 - t * t) * (1.0 - t * t) : 0.0;
  };
  auto q = FitWeighted(samples, centring, Vector3d::Zero(), one);
  for (int i = 0; q && i < kAbsoluteIterations; ++i) {
    q = FitWeighted(samples, centring, *q, absolute);
  }
  for (int i = 0; q && i < kTukeyIterations; ++i) q = FitWeighted(samples, centring, *q, tukey);
  if (!q) return std::nullopt;
  const Vector3d abc = centring.ToPlane() * *q;
  DisparityPlaneFit result{.plane = {.a = abc.x(), .b = abc.y(), .c = abc.z()}};
  const auto inliers = std::count_if(samples.begin(), samples.end(), [&](const auto& s) {
    return std::abs(result.plane.Residual(s)) <= tolerance_px;
  });
  result.inlier_share = static_cast<double>(inliers) / static_cast<double>(samples.size());
  return result;
}

}  // namespace fenestra
