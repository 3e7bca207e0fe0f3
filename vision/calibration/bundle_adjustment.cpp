#include "vision/calibration/bundle_adjustment.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/io/input_error.h"
#include "core/system/check.h"

namespace fenestra {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using CameraVector = Eigen::Matrix<double, kCameraParameters, 1>;
/// A pose as Ceres holds it: unit quaternion and translation.
using PoseVector = Eigen::Matrix<double, 7, 1>;
using PoseStep = Eigen::Matrix<double, 6, 1>;

constexpr int kRight = kCameraParameters;
constexpr int kRelative = 2 * kCameraParameters;
constexpr int kK3 = 8;

PoseVector ToVector(const Pose& X) {
  PoseVector vector;
  vector << Quaterniond(X.rotation()).normalized().coeffs(), X.translation();
  return vector;
}

Pose ToPose(const double* vector) {
  return Pose(Quaterniond(vector).toRotationMatrix(), Vector3d(vector + 4));
}

// Steps (δ, dt) lead from R and t to exp(δ) R and t + dt. Derivatives by a pose are given by its
// step, in the first six of seven columns; the last one is 0.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return PoseVector::SizeAtCompileTime; }
  int TangentSize() const override { return PoseStep::SizeAtCompileTime; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const Pose X = ToPose(x);
    const Eigen::Map<const PoseStep> step(delta);
    if (!step.allFinite()) return false;
    Eigen::Map<PoseVector> moved(x_plus_delta);
    moved = ToVector(
        Pose(RotationFromVector(step.head<3>()) * X.rotation(), X.translation() + step.tail<3>()));
    return true;
  }
  bool PlusJacobian(const double* /*x*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> by_step(jacobian);
    by_step.setIdentity();
    return true;
  }
  // Least squares with derivatives do without differences of poses.
  bool Minus(const double*, const double*, double*) const override { return false; }
  bool MinusJacobian(const double*, double*) const override { return false; }
};

// Derivative of exp(δ) (R q) + t by (δ, t), with turned = R q.
Eigen::Matrix<double, 3, 6> ByPose(const Vector3d& turned) {
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << -CrossMatrix(turned), Eigen::Matrix3d::Identity();
  return by_pose;
}

// Residuals √w (pixel - projection) of the corners that one camera saw in one view, by the camera's
// parameters, X_LG and, of the right camera, X_RL. Fails if a corner has no projection.
class CornersCost final : public ceres::CostFunction {
 public:
  CornersCost(const CameraModel& camera, bool is_right, const std::vector<BoardCorner>& corners,
              double weight, const CalibrationBoard& board)
      : camera_(camera),
        is_right_(is_right),
        corners_(corners),
        root_weight_(std::sqrt(weight)),
        board_(board) {
    set_num_residuals(2 * static_cast<int>(corners.size()));
    *mutable_parameter_block_sizes() = {kCameraParameters, 7};
    if (is_right) mutable_parameter_block_sizes()->push_back(7);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const CameraVector> vector(parameters[0]);
    if (!vector.allFinite() || vector[0] <= 0.0 || vector[1] <= 0.0) return false;
    const CameraModel camera = camera_.WithParameters(vector);
    const Pose X_LG = ToPose(parameters[1]);
    const Pose X_CL = is_right_ ? ToPose(parameters[2]) : Pose();
    for (size_t i = 0; i < corners_.size(); ++i) {
      const Vector3d turned = X_LG.rotation() * board_.Corner(corners_[i].id);
      const Vector3d p_LQ = turned + X_LG.translation();
      const auto seen = camera.Linearise(X_CL * p_LQ);
      if (!seen) return false;
      Eigen::Map<Eigen::Vector2d> residual(residuals + 2 * i);
      residual = root_weight_ * (corners_[i].pixel - seen->pixel);
      if (jacobians == nullptr) continue;
      SetDerivative(i, 9, seen->by_parameters, jacobians[0]);
      SetDerivative(i, 7, seen->by_point * X_CL.rotation() * ByPose(turned), jacobians[1]);
      if (!is_right_) continue;
      SetDerivative(i, 7, seen->by_point * ByPose(X_CL.rotation() * p_LQ), jacobians[2]);
    }
    return true;
  }

 private:
  // `jacobian`: the rows of all corners, or null where Ceres does not ask for it.
  template <typename Derivative>
  void SetDerivative(size_t corner, int columns, const Derivative& of_pixel,
                     double* jacobian) const {
    if (jacobian == nullptr) return;
    Eigen::Map<Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>> rows(
        jacobian + 2 * corner * static_cast<size_t>(columns), 2, columns);
    rows.setZero();
    rows.leftCols(of_pixel.cols()) = -root_weight_ * of_pixel;
  }

  CameraModel camera_;
  bool is_right_;
  const std::vector<BoardCorner>& corners_;
  double root_weight_;
  const CalibrationBoard& board_;
};

// The parameters where Ceres changes them, and the residuals that depend on them.
class PairProblem {
 public:
  PairProblem(const PairState& start, const std::vector<BoardView>& views,
              const CalibrationBoard& board, const AdjustmentOptions& options)
      : start_(start),
        left_(start.cameras.left.ParameterVector()),
        right_(start.cameras.right.ParameterVector()),
        X_RL_(ToVector(start.cameras.X_RL)) {
    for (CameraVector* camera : {&left_, &right_}) {
      problem_.AddParameterBlock(
          camera->data(), kCameraParameters,
          options.free_k3 ? nullptr : new ceres::SubsetManifold(kCameraParameters, {kK3}));
    }
    problem_.AddParameterBlock(X_RL_.data(), 7, new PoseManifold);
    for (const Pose& X_LG : start.X_LG) X_LG_.push_back(ToVector(X_LG));
    for (size_t i = 0; i < views.size(); ++i) {
      const BoardView& view = views[i];
      problem_.AddParameterBlock(X_LG_[i].data(), 7, new PoseManifold);
      if (!view.left.empty()) {
        problem_.AddResidualBlock(
            new CornersCost(start.cameras.left, false, view.left, view.left_weight, board), nullptr,
            left_.data(), X_LG_[i].data());
      }
      if (!view.right.empty()) {
        problem_.AddResidualBlock(
            new CornersCost(start.cameras.right, true, view.right, view.right_weight, board),
            nullptr, right_.data(), X_LG_[i].data(), X_RL_.data());
      }
    }
  }

  ceres::Solver::Summary Minimise() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;  // Eliminates the board poses.
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-12;  // Relative change of the sum of squares.
    options.gradient_tolerance = 0.0;
    options.parameter_tolerance = 0.0;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary;
  }

  PairState State() const {
    PairState state = start_;
    state.cameras = {.left = start_.cameras.left.WithParameters(left_),
                     .right = start_.cameras.right.WithParameters(right_),
                     .X_RL = ToPose(X_RL_.data())};
    for (size_t i = 0; i < X_LG_.size(); ++i) state.X_LG[i] = ToPose(X_LG_[i].data());
    return state;
  }

  PairMatrix Cofactor() {
    ceres::Covariance covariance{ceres::Covariance::Options()};
    const std::vector<const double*> blocks = {left_.data(), right_.data(), X_RL_.data()};
    if (!covariance.Compute(blocks, &problem_)) {
      throw InputError("calibration",
                       "the views do not determine the cameras: the board has to be tilted in "
                       "different directions, near and far");
    }
    // X_RL's seventh row and column are 0.
    Eigen::Matrix<double, kPairParameters + 1, kPairParameters + 1> all;
    FENESTRA_CHECK(covariance.GetCovarianceMatrix(blocks, all.data()), "no covariance");
    return all.topLeftCorner<kPairParameters, kPairParameters>();
  }

 private:
  PairState start_;
  CameraVector left_;
  CameraVector right_;
  PoseVector X_RL_;
  std::vector<PoseVector> X_LG_;
  ceres::Problem problem_;
};

}  // namespace

PairVector PairError(const StereoCalibration& estimate, const StereoCalibration& truth) {
  PairVector error;
  error.head<kCameraParameters>() = truth.left.ParameterVector() - estimate.left.ParameterVector();
  error.segment<kCameraParameters>(kRight) =
      truth.right.ParameterVector() - estimate.right.ParameterVector();
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(truth.X_RL.rotation() * estimate.X_RL.rotation().transpose()));
  error.segment<3>(kRelative) = turn.angle() * turn.axis();
  error.tail<3>() = truth.X_RL.translation() - estimate.X_RL.translation();
  return error;
}

AdjustedPair AdjustPair(const PairState& start, const std::vector<BoardView>& views,
                        const CalibrationBoard& board, const AdjustmentOptions& options) {
  FENESTRA_CHECK(start.X_LG.size() == views.size(), "each view needs a board pose to start from");
  // Exceptions say what Ceres would write to standard error.
  [[maybe_unused]] static const int least_level = FLAGS_minloglevel = google::GLOG_FATAL;
  PairProblem problem(start, views, board, options);
  const ceres::Solver::Summary summary = problem.Minimise();
  if (!summary.IsSolutionUsable()) {
    throw InputError("calibration", "the start lies outside the lens model's valid domain");
  }
  if (summary.num_residuals <= summary.num_effective_parameters) {
    throw InputError("calibration", "there are fewer corners than the cameras' parameters need");
  }
  return {.state = problem.State(),
          .squared_residuals = 2.0 * summary.final_cost,
          .residual_count = summary.num_residuals,
          .unknown_count = summary.num_effective_parameters,
          .cofactor = problem.Cofactor()};
}

}  // namespace fenestra
