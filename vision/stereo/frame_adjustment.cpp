#include "vision/stereo/frame_adjustment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

constexpr int kMost = FrameRectangle::kParameters;
constexpr int kIterations = 25;
constexpr double kTukey = 4.685;
constexpr double kConverged = 1e-7;  // Squared step in standard deviations.

using Matrix = Eigen::Matrix<double, kMost, kMost>;
using Vector = FrameRectangle::Step;
using Points = std::array<std::vector<EdgePoint>, 2>;

// In standard deviations; nullopt where a point is behind a camera.
std::optional<std::vector<double>> Residuals(const std::array<CameraView, 2>& views,
                                             const Points& points, const FrameRectangle& frame) {
  std::vector<double> residuals;
  for (size_t view = 0; view < 2; ++view) {
    for (const EdgePoint& point : points[view]) {
      const Eigen::Vector3d p_LQ = frame.PointOn(point.side, point.border, point.share);
      const auto pixel = views[view].camera.Project(views[view].X_CL * p_LQ);
      if (!pixel) return std::nullopt;
      residuals.push_back(point.normal.dot(*pixel - point.pixel) / point.sigma_px);
    }
  }
  return residuals;
}

double RobustScale(std::vector<double> residuals) {
  for (double& r : residuals) r = std::abs(r);
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return std::max(1.0, 1.4826 * *middle);
}

double Weight(double residual, double scale) {
  const double x = residual / (kTukey * scale);
  return std::abs(x) >= 1.0 ? 0.0 : (1.0 - x * x) * (1.0 - x * x);
}

double Loss(double residual, double scale) {
  const double c = kTukey * scale;
  const double x = std::min(1.0, std::abs(residual) / c);
  const double rest = 1.0 - x * x;
  return c * c / 3.0 * (1.0 - rest * rest * rest);
}

double TotalLoss(const std::vector<double>& residuals, double scale) {
  double sum = 0.0;
  for (const double r : residuals) sum += Loss(r, scale);
  return sum;
}

struct NormalEquations {
  Matrix matrix = Matrix::Zero();
  Vector gradient = Vector::Zero();
};

NormalEquations Linearise(const std::array<CameraView, 2>& views, const Points& points,
                          const FrameRectangle& frame, double scale) {
  NormalEquations equations;
  for (size_t view = 0; view < 2; ++view) {
    const Eigen::Matrix3d& R_CL = views[view].X_CL.rotation();
    for (const EdgePoint& point : points[view]) {
      const auto on_side = frame.LineariseOn(point.side, point.border, point.share);
      const auto projected = views[view].camera.Linearise(views[view].X_CL * on_side.p_LQ);
      if (!projected) continue;
      const Eigen::RowVector3d by_point =
          point.normal.transpose() * projected->by_point * R_CL / point.sigma_px;
      const Vector j = (by_point * on_side.by_parameters).transpose();
      const double residual = point.normal.dot(projected->pixel - point.pixel) / point.sigma_px;
      const double weight = Weight(residual, scale);
      equations.matrix.noalias() += weight * j * j.transpose();
      equations.gradient.noalias() -= weight * residual * j;
    }
  }
  return equations;
}

void AddPrior(const FrameRectangle& frame, const SizePrior& prior, NormalEquations& equations) {
  const double information = 1.0 / (prior.sigma_m * prior.sigma_m);
  equations.matrix(6, 6) += information;
  equations.matrix(7, 7) += information;
  equations.gradient[6] += information * (prior.width_m - frame.width_m);
  equations.gradient[7] += information * (prior.height_m - frame.height_m);
}

double PriorLoss(const FrameRectangle& frame, const std::optional<SizePrior>& prior) {
  if (!prior) return 0.0;
  const double w = (frame.width_m - prior->width_m) / prior->sigma_m;
  const double h = (frame.height_m - prior->height_m) / prior->sigma_m;
  return w * w + h * h;
}

bool HasInner(const Points& points) {
  for (const std::vector<EdgePoint>& view : points) {
    for (const EdgePoint& point : view) {
      if (point.border == Border::kInner) return true;
    }
  }
  return false;
}

// Solves for the first `count` parameters; the others stay.
Vector Solve(const NormalEquations& equations, int count, double damping) {
  Eigen::MatrixXd matrix = equations.matrix.topLeftCorner(count, count);
  matrix.diagonal() *= 1.0 + damping;
  Vector step = Vector::Zero();
  step.head(count) = matrix.ldlt().solve(equations.gradient.head(count));
  return step;
}

}  // namespace

std::optional<FrameAdjustment> AdjustFrame(const std::array<CameraView, 2>& views,
                                           const Points& points, const FrameRectangle& start,
                                           const std::optional<SizePrior>& prior) {
  const int count = HasInner(points) ? kMost : kMost - 1;
  if (points[0].size() + points[1].size() < 2 * kMost) return std::nullopt;
  FrameAdjustment result;
  result.frame = start;
  auto residuals = Residuals(views, points, start);
  if (!residuals) return std::nullopt;
  double scale = RobustScale(*residuals);
  double damping = 1e-4;
  NormalEquations equations;
  for (int i = 0; i < kIterations; ++i) {
    equations = Linearise(views, points, result.frame, scale);
    if (prior) AddPrior(result.frame, *prior, equations);
    const Vector step = Solve(equations, count, damping);
    if (!step.allFinite()) return std::nullopt;
    const FrameRectangle moved = result.frame.Moved(step);
    const auto after = Residuals(views, points, moved);
    const double loss_before = TotalLoss(*residuals, scale) + PriorLoss(result.frame, prior);
    if (!after || TotalLoss(*after, scale) + PriorLoss(moved, prior) > loss_before) {
      damping *= 10.0;
      if (damping > 1e6) break;
      continue;
    }
    const double size = step.dot(equations.matrix * step);
    result.frame = moved;
    residuals = after;
    damping = std::max(1e-9, 0.1 * damping);
    scale = RobustScale(*residuals);
    if (size < kConverged) break;
  }
  equations = Linearise(views, points, result.frame, scale);
  if (prior) AddPrior(result.frame, *prior, equations);
  double squares = 0.0;
  double weights = 0.0;
  size_t next = 0;
  for (size_t view = 0; view < 2; ++view) {
    for (size_t i = 0; i < points[view].size(); ++i) {
      const double residual = (*residuals)[next++];
      const double weight = Weight(residual, scale);
      result.weights[view].push_back(weight);
      squares += weight * residual * residual;
      weights += weight;
    }
  }
  if (weights <= 1.5 * count) return std::nullopt;
  result.scale = std::sqrt(squares / (weights - count));
  const Eigen::MatrixXd information = equations.matrix.topLeftCorner(count, count);
  const Eigen::LDLT<Eigen::MatrixXd> decomposition(information);
  if (decomposition.info() != Eigen::Success || !decomposition.isPositive()) return std::nullopt;
  result.covariance.setZero();
  result.covariance.topLeftCorner(count, count) =
      std::max(1.0, result.scale * result.scale) *
      decomposition.solve(Eigen::MatrixXd::Identity(count, count));
  if (!result.covariance.allFinite()) return std::nullopt;
  return result;
}

}  // namespace fenestra
