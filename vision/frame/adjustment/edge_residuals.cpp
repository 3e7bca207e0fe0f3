#include "vision/frame/adjustment/edge_residuals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace fenestra {
namespace {

constexpr double kTukey = 4.685;
constexpr double kInlier = 3.5;

using Matrix = Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters>;
using Vector = FrameRectangle::Step;

double LossOf(const EdgeLoss& loss, double residual) {
  if (loss.square) return std::pow(std::min(std::abs(residual), kInlier * loss.scale), 2);
  const double c = kTukey * loss.scale;
  const double x = std::min(1.0, std::abs(residual) / c);
  const double rest = 1.0 - x * x;
  return c * c / 3.0 * (1.0 - rest * rest * rest);
}

}  // namespace

std::optional<std::vector<double>> EdgeResiduals(std::span<const CameraView> views,
                                                 const EdgePointsByView& points,
                                                 const FrameRectangle& frame) {
  std::vector<double> residuals;
  for (size_t view = 0; view < points.size(); ++view) {
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

double EdgeLoss::Weight(double residual) const {
  if (square) return std::abs(residual) < kInlier * scale ? 1.0 : 0.0;
  const double x = residual / (kTukey * scale);
  return std::abs(x) >= 1.0 ? 0.0 : (1.0 - x * x) * (1.0 - x * x);
}

double EdgeLoss::Of(const std::vector<double>& residuals) const {
  double sum = 0.0;
  for (const double residual : residuals) sum += LossOf(*this, residual);
  return sum;
}

NormalEquations LineariseEdges(std::span<const CameraView> views, const EdgePointsByView& points,
                               const FrameRectangle& frame, const EdgeLoss& loss) {
  NormalEquations equations;
  for (size_t view = 0; view < points.size(); ++view) {
    const Eigen::Matrix3d& R_CL = views[view].X_CL.rotation();
    for (const EdgePoint& point : points[view]) {
      const auto on_side = frame.LineariseOn(point.side, point.border, point.share);
      const auto projected = views[view].camera.Linearise(views[view].X_CL * on_side.p_LQ);
      if (!projected) continue;
      const Eigen::RowVector3d by_point =
          point.normal.transpose() * projected->by_point * R_CL / point.sigma_px;
      const FrameRectangle::Step j = (by_point * on_side.by_parameters).transpose();
      const double residual = point.normal.dot(projected->pixel - point.pixel) / point.sigma_px;
      const double weight = loss.Weight(residual);
      equations.matrix.noalias() += weight * j * j.transpose();
      equations.gradient.noalias() -= weight * residual * j;
    }
  }
  return equations;
}

Matrix CommonErrors(std::span<const CameraView> views, const EdgePointsByView& points,
                    const FrameRectangle& frame, const EdgeLoss& loss) {
  Matrix sum = Matrix::Zero();
  for (size_t view = 0; view < points.size(); ++view) {
    std::array<std::array<Vector, 4>, 2> groups;
    std::array<std::array<double, 4>, 2> sigmas_px = {};
    for (auto& border : groups) border.fill(Vector::Zero());
    const Eigen::Matrix3d& R_CL = views[view].X_CL.rotation();
    for (const EdgePoint& point : points[view]) {
      const auto on_side = frame.LineariseOn(point.side, point.border, point.share);
      const auto projected = views[view].camera.Linearise(views[view].X_CL * on_side.p_LQ);
      if (!projected) continue;
      const Eigen::RowVector3d by_point = point.normal.transpose() * projected->by_point * R_CL;
      const double residual = point.normal.dot(projected->pixel - point.pixel) / point.sigma_px;
      const double weight = loss.Weight(residual) / (point.sigma_px * point.sigma_px);
      const auto border = static_cast<size_t>(point.border);
      const auto side = static_cast<size_t>(point.side);
      groups[border][side] += weight * (by_point * on_side.by_parameters).transpose();
      sigmas_px[border][side] = point.common_sigma_px;
    }
    for (size_t border = 0; border < 2; ++border) {
      for (size_t side = 0; side < 4; ++side) {
        const Vector v = sigmas_px[border][side] * groups[border][side];
        sum.noalias() += v * v.transpose();
      }
    }
  }
  return sum;
}

}  // namespace fenestra
