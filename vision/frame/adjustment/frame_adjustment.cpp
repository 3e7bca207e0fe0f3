#include "vision/frame/adjustment/frame_adjustment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "vision/frame/adjustment/edge_residuals.h"

namespace fenestra {
namespace {

constexpr size_t kFewestPoints = 20;
constexpr int kIterations = 25;
constexpr double kConverged = 1e-7;  // Squared step in standard deviations.

using Vector = FrameRectangle::Step;
using Points = EdgePointsByView;

bool HasInner(const Points& points) {
  for (const std::vector<EdgePoint>& view : points) {
    for (const EdgePoint& point : view) {
      if (point.border == Border::kInner) return true;
    }
  }
  return false;
}

std::vector<int> FittedParameters(const Points& points, const FramePrior& prior) {
  std::vector<int> fitted = {0, 1, 2, 3, 4, 5, 6, 7};
  const bool inner = HasInner(points);
  if (inner) fitted.push_back(8);
  if (prior.outer_relief) fitted.insert(fitted.end(), {9, 10, 11, 12});
  if (inner && prior.inner_relief) fitted.push_back(13);
  return fitted;
}

class Adjustment {
 public:
  Adjustment(std::span<const CameraView> views, const Points& points, const FramePrior& prior)
      : views_(views), points_(points), prior_(prior), fitted_(FittedParameters(points, prior)) {}

  // Returns false if points cannot be projected.
  bool Start(const FrameRectangle& frame) {
    frame_ = frame;
    auto residuals = EdgeResiduals(views_, points_, frame);
    if (!residuals) return false;
    residuals_ = std::move(*residuals);
    loss_ = {RobustScale(residuals_), false};
    return true;
  }

  bool Minimise(bool square) {
    loss_.square = square;
    double damping = 1e-4;
    for (int i = 0; i < kIterations; ++i) {
      const NormalEquations equations = Equations(loss_.scale * loss_.scale);
      const Vector step = Solve(equations, damping);
      if (!step.allFinite()) return false;
      const FrameRectangle moved = frame_.Moved(step);
      const auto after = EdgeResiduals(views_, points_, moved);
      if (!after || !(LossOf(moved, *after) <= LossOf(frame_, residuals_))) {
        damping *= 10.0;
        if (damping > 1e6) break;
        continue;
      }
      const double size = step.dot(equations.matrix * step);
      frame_ = moved;
      residuals_ = *after;
      damping = std::max(1e-9, 0.1 * damping);
      if (!square) loss_.scale = RobustScale(residuals_);
      if (size < kConverged) break;
    }
    return true;
  }

  std::optional<FrameAdjustment> Result() const {
    FrameAdjustment result;
    result.frame = frame_;
    double squares = 0.0;
    double count = 0.0;
    size_t next = 0;
    result.is_inlier.resize(points_.size());
    for (size_t view = 0; view < points_.size(); ++view) {
      for (size_t i = 0; i < points_[view].size(); ++i) {
        const double residual = residuals_[next++];
        const double weight = loss_.Weight(residual);
        result.is_inlier[view].push_back(weight > 0.0);
        squares += weight * residual * residual;
        count += weight;
      }
    }
    const auto parameters = static_cast<double>(fitted_.size());
    if (count <= 1.5 * parameters) return std::nullopt;
    result.scale = std::sqrt(squares / (count - parameters));
    // Edges may be off by more than their noise; this does not apply to measured planes.
    const double excess = std::max(1.0, result.scale * result.scale);
    const Eigen::MatrixXd information = Equations(excess).matrix(fitted_, fitted_);
    const Eigen::LDLT<Eigen::MatrixXd> decomposition(information);
    if (decomposition.info() != Eigen::Success || !decomposition.isPositive()) return std::nullopt;
    const auto size = static_cast<Eigen::Index>(fitted_.size());
    result.covariance.setZero();
    const Eigen::MatrixXd inverse = decomposition.solve(Eigen::MatrixXd::Identity(size, size));
    const Eigen::MatrixXd common = CommonErrors(views_, points_, frame_, loss_)(fitted_, fitted_);
    result.covariance(fitted_, fitted_) = excess * inverse + inverse * common * inverse;
    if (!result.covariance.allFinite()) return std::nullopt;
    return result;
  }

 private:
  NormalEquations Equations(double plane_weight) const {
    NormalEquations equations = LineariseEdges(views_, points_, frame_, loss_);
    AddPrior(frame_, prior_, plane_weight, equations);
    return equations;
  }

  double LossOf(const FrameRectangle& frame, const std::vector<double>& residuals) const {
    return loss_.Of(residuals) + LossOfPrior(frame, prior_, loss_.scale * loss_.scale);
  }

  // Covariance of the fitted parameters; the others remain zero.
  Vector Solve(const NormalEquations& equations, double damping) const {
    Eigen::MatrixXd matrix = equations.matrix(fitted_, fitted_);
    matrix.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd gradient = equations.gradient(fitted_);
    Vector step = Vector::Zero();
    const Eigen::VectorXd change = matrix.ldlt().solve(gradient);
    step(fitted_) = change;
    return step;
  }

  std::span<const CameraView> views_;
  const Points& points_;
  FramePrior prior_;
  std::vector<int> fitted_;
  FrameRectangle frame_;
  std::vector<double> residuals_;
  EdgeLoss loss_{1.0, false};
};

}  // namespace

std::optional<FrameAdjustment> AdjustFrame(std::span<const CameraView> views, const Points& points,
                                           const FrameRectangle& start, const FramePrior& prior) {
  size_t count = 0;
  for (const std::vector<EdgePoint>& view : points) count += view.size();
  if (count < kFewestPoints) return std::nullopt;
  Adjustment adjustment(views, points, prior);
  if (!adjustment.Start(start)) return std::nullopt;
  if (!adjustment.Minimise(false) || !adjustment.Minimise(true)) return std::nullopt;
  return adjustment.Result();
}

}  // namespace fenestra
