#include "vision/frame/frame_adjustment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

constexpr int kMost = FrameRectangle::kParameters;
constexpr size_t kFewestPoints = 20;
constexpr int kIterations = 25;
constexpr double kTukey = 4.685;
constexpr double kInlier = 3.5;
constexpr double kConverged = 1e-7;  // Squared step in standard deviations.

using Matrix = Eigen::Matrix<double, kMost, kMost>;
using Vector = FrameRectangle::Step;
using Points = std::vector<std::vector<EdgePoint>>;

// In standard deviations; nullopt where a point is behind a camera.
std::optional<std::vector<double>> Residuals(std::span<const CameraView> views,
                                             const Points& points, const FrameRectangle& frame) {
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

// What a residual costs. Tukey's biweight, or its square up to a limit.
struct Loss {
  double scale;
  bool square;

  double Weight(double residual) const {
    if (square) return std::abs(residual) < kInlier * scale ? 1.0 : 0.0;
    const double x = residual / (kTukey * scale);
    return std::abs(x) >= 1.0 ? 0.0 : (1.0 - x * x) * (1.0 - x * x);
  }
  double Of(double residual) const {
    if (square) return std::pow(std::min(std::abs(residual), kInlier * scale), 2);
    const double c = kTukey * scale;
    const double x = std::min(1.0, std::abs(residual) / c);
    const double rest = 1.0 - x * x;
    return c * c / 3.0 * (1.0 - rest * rest * rest);
  }
  double Of(const std::vector<double>& residuals) const {
    double sum = 0.0;
    for (const double r : residuals) sum += Of(r);
    return sum;
  }
};

struct NormalEquations {
  Matrix matrix = Matrix::Zero();
  Vector gradient = Vector::Zero();
};

NormalEquations Linearise(std::span<const CameraView> views, const Points& points,
                          const FrameRectangle& frame, const Loss& loss) {
  NormalEquations equations;
  for (size_t view = 0; view < points.size(); ++view) {
    const Eigen::Matrix3d& R_CL = views[view].X_CL.rotation();
    for (const EdgePoint& point : points[view]) {
      const auto on_side = frame.LineariseOn(point.side, point.border, point.share);
      const auto projected = views[view].camera.Linearise(views[view].X_CL * on_side.p_LQ);
      if (!projected) continue;
      const Eigen::RowVector3d by_point =
          point.normal.transpose() * projected->by_point * R_CL / point.sigma_px;
      const Vector j = (by_point * on_side.by_parameters).transpose();
      const double residual = point.normal.dot(projected->pixel - point.pixel) / point.sigma_px;
      const double weight = loss.Weight(residual);
      equations.matrix.noalias() += weight * j * j.transpose();
      equations.gradient.noalias() -= weight * residual * j;
    }
  }
  return equations;
}

// A parameter that is known to some extent.
struct Known {
  int parameter;
  double value;
  double sigma;
};

std::vector<Known> AllKnown(const FrameKnowledge& knowledge) {
  std::vector<Known> known;
  if (knowledge.size) {
    known.push_back({6, knowledge.size->width_m, knowledge.size->sigma_m});
    known.push_back({7, knowledge.size->height_m, knowledge.size->sigma_m});
  }
  if (knowledge.outer_relief) {
    for (int i = 9; i < 13; ++i) {
      known.push_back({i, knowledge.outer_relief->mean_m, knowledge.outer_relief->sigma_m});
    }
  }
  if (knowledge.inner_relief) {
    known.push_back({13, knowledge.inner_relief->mean_m, knowledge.inner_relief->sigma_m});
  }
  return known;
}

double ValueOf(const FrameRectangle& frame, int parameter) {
  if (parameter == 6) return frame.width_m;
  if (parameter == 7) return frame.height_m;
  if (parameter == 13) return frame.inner_relief_m;
  return frame.outer_relief_m[static_cast<size_t>(parameter - 9)];
}

void AddKnown(const FrameRectangle& frame, const std::vector<Known>& known,
              NormalEquations& equations) {
  for (const Known& k : known) {
    const double information = 1.0 / (k.sigma * k.sigma);
    equations.matrix(k.parameter, k.parameter) += information;
    equations.gradient[k.parameter] += information * (k.value - ValueOf(frame, k.parameter));
  }
}

double LossOfKnown(const FrameRectangle& frame, const std::vector<Known>& known) {
  double sum = 0.0;
  for (const Known& k : known) {
    sum += std::pow((ValueOf(frame, k.parameter) - k.value) / k.sigma, 2);
  }
  return sum;
}

// m of a measured plane as the frame has it, minus the measured one.
Eigen::Vector3d PlaneResidual(const FrameRectangle& frame, const PlaneMeasurement& plane) {
  const Eigen::Vector3d normal = frame.R_LO.col(2);
  return normal / (normal.dot(frame.p_LO) + plane.relief_m) - plane.m;
}

// `weight`: by how much residuals of edges are larger than their standard deviations, squared.
void AddPlanes(const FrameRectangle& frame, const std::vector<PlaneMeasurement>& planes,
               double weight, NormalEquations& equations) {
  for (const PlaneMeasurement& plane : planes) {
    const Eigen::Vector3d normal = frame.R_LO.col(2);
    const double q = normal.dot(frame.p_LO) + plane.relief_m;
    Eigen::Matrix3d normal_by_turn;  // R (turn x e_z).
    normal_by_turn << -frame.R_LO.col(1), frame.R_LO.col(0), Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, 6> j;
    j.leftCols<3>() =
        (Eigen::Matrix3d::Identity() - normal * frame.p_LO.transpose() / q) * normal_by_turn / q;
    j.rightCols<3>() = -normal * normal.transpose() / (q * q);
    const Eigen::Matrix<double, 6, 3> weighted = weight * j.transpose() * plane.information;
    equations.matrix.topLeftCorner<6, 6>() += weighted * j;
    equations.gradient.head<6>() -= weighted * PlaneResidual(frame, plane);
  }
}

double LossOfPlanes(const FrameRectangle& frame, const std::vector<PlaneMeasurement>& planes,
                    double weight) {
  double sum = 0.0;
  for (const PlaneMeasurement& plane : planes) {
    const Eigen::Vector3d residual = PlaneResidual(frame, plane);
    sum += weight * residual.dot(plane.information * residual);
  }
  return sum;
}

bool HasInner(const Points& points) {
  for (const std::vector<EdgePoint>& view : points) {
    for (const EdgePoint& point : view) {
      if (point.border == Border::kInner) return true;
    }
  }
  return false;
}

std::vector<int> FittedParameters(const Points& points, const FrameKnowledge& knowledge) {
  std::vector<int> fitted = {0, 1, 2, 3, 4, 5, 6, 7};
  const bool inner = HasInner(points);
  if (inner) fitted.push_back(8);
  if (knowledge.outer_relief) fitted.insert(fitted.end(), {9, 10, 11, 12});
  if (inner && knowledge.inner_relief) fitted.push_back(13);
  return fitted;
}

class Adjustment {
 public:
  Adjustment(std::span<const CameraView> views, const Points& points,
             const FrameKnowledge& knowledge)
      : views_(views),
        points_(points),
        known_(AllKnown(knowledge)),
        planes_(knowledge.planes),
        fitted_(FittedParameters(points, knowledge)) {}

  // False if the points cannot be seen from there.
  bool Start(const FrameRectangle& frame) {
    frame_ = frame;
    auto residuals = Residuals(views_, points_, frame);
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
      const auto after = Residuals(views_, points_, moved);
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
    // Edges may be off by more than their noise; measured planes are not, because of that.
    const double excess = std::max(1.0, result.scale * result.scale);
    const Eigen::MatrixXd information = Equations(excess).matrix(fitted_, fitted_);
    const Eigen::LDLT<Eigen::MatrixXd> decomposition(information);
    if (decomposition.info() != Eigen::Success || !decomposition.isPositive()) return std::nullopt;
    const auto size = static_cast<Eigen::Index>(fitted_.size());
    result.covariance.setZero();
    const Eigen::MatrixXd inverse = decomposition.solve(Eigen::MatrixXd::Identity(size, size));
    result.covariance(fitted_, fitted_) = excess * inverse;
    if (!result.covariance.allFinite()) return std::nullopt;
    return result;
  }

 private:
  NormalEquations Equations(double plane_weight) const {
    NormalEquations equations = Linearise(views_, points_, frame_, loss_);
    AddKnown(frame_, known_, equations);
    AddPlanes(frame_, planes_, plane_weight, equations);
    return equations;
  }

  double LossOf(const FrameRectangle& frame, const std::vector<double>& residuals) const {
    return loss_.Of(residuals) + LossOfKnown(frame, known_) +
           LossOfPlanes(frame, planes_, loss_.scale * loss_.scale);
  }

  // Of the fitted parameters; the others stay.
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
  std::vector<Known> known_;
  std::vector<PlaneMeasurement> planes_;
  std::vector<int> fitted_;
  FrameRectangle frame_;
  std::vector<double> residuals_;
  Loss loss_{1.0, false};
};

}  // namespace

std::optional<FrameAdjustment> AdjustFrame(std::span<const CameraView> views, const Points& points,
                                           const FrameRectangle& start,
                                           const FrameKnowledge& knowledge) {
  size_t count = 0;
  for (const std::vector<EdgePoint>& view : points) count += view.size();
  if (count < kFewestPoints) return std::nullopt;
  Adjustment adjustment(views, points, knowledge);
  if (!adjustment.Start(start)) return std::nullopt;
  if (!adjustment.Minimise(false) || !adjustment.Minimise(true)) return std::nullopt;
  return adjustment.Result();
}

}  // namespace fenestra
