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

// What the shared errors of one side in one view do to the gradient.
struct SharedErrors {
  Vector common = Vector::Zero();  // By the error of all its points.
  Eigen::Matrix<double, FrameRectangle::kParameters, 2> shift =
      Eigen::Matrix<double, FrameRectangle::kParameters, 2>::Zero();  // By displacements.
  Eigen::Vector2d places = Eigen::Vector2d::Zero();                   // Sum.
  double count = 0.0;

  void Add(const EdgePoint& point, const Eigen::Vector2d& place, const Vector& by_pixel) {
    common += point.common_sigma_px * by_pixel;
    shift.noalias() += point.shift_sigma_px * by_pixel * point.normal.transpose();
    places += place;
    count += 1.0;
  }
};

void AddSharedErrors(std::span<const SharedErrors> sides, Matrix& sum) {
  for (const SharedErrors& a : sides) {
    if (a.count == 0.0) continue;
    sum.noalias() += a.common * a.common.transpose();
    for (const SharedErrors& b : sides) {
      if (b.count == 0.0) continue;
      sum.noalias() +=
          ShiftCorrelation(a.places / a.count, b.places / b.count) * a.shift * b.shift.transpose();
    }
  }
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
    std::array<SharedErrors, 8> sides;
    const CameraView& seen = views[view];
    for (const EdgePoint& point : points[view]) {
      const auto on_side = frame.LineariseOn(point.side, point.border, point.share);
      const auto projected = seen.camera.Linearise(seen.X_CL * on_side.p_LQ);
      if (!projected) continue;
      const Eigen::RowVector3d by_point =
          point.normal.transpose() * projected->by_point * seen.X_CL.rotation();
      const double residual = point.normal.dot(projected->pixel - point.pixel) / point.sigma_px;
      const double weight = loss.Weight(residual) / (point.sigma_px * point.sigma_px);
      sides[4 * static_cast<size_t>(point.border) + static_cast<size_t>(point.side)].Add(
          point, PlaceInImage(seen.camera, point.pixel),
          weight * (by_point * on_side.by_parameters).transpose());
    }
    AddSharedErrors(sides, sum);
  }
  return sum;
}

}  // namespace fenestra
