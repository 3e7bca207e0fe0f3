#include "vision/calibration/bundle_adjustment.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/io/input_error.h"
#include "core/system/check.h"

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using PoseVector = Eigen::Matrix<double, 6, 1>;
using PoseMatrix = Eigen::Matrix<double, 6, 6>;

constexpr int kRight = kCameraParameters;
constexpr int kRelative = 2 * kCameraParameters;
constexpr int kK3 = 8;

Matrix3d Cross(const Vector3d& a) {
  Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

// exp(δ) R and t + dt.
Pose Moved(const Pose& X, const PoseVector& step) {
  const Eigen::Quaterniond rotation(RotationFromVector(step.head<3>()) * X.rotation());
  return Pose(rotation.normalized().toRotationMatrix(), X.translation() + step.tail<3>());
}

// Derivative of exp(δ) (R q) + t by (δ, t), with turned = R q.
Eigen::Matrix<double, 3, 6> ByPose(const Vector3d& turned) {
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << -Cross(turned), Matrix3d::Identity();
  return by_pose;
}

// Normal equations: [A B; Bᵀ C] with one block C, and one of B's columns, for each view.
struct NormalEquations {
  explicit NormalEquations(size_t views)
      : B(views, Eigen::Matrix<double, kPairParameters, 6>::Zero()),
        C(views, PoseMatrix::Zero()),
        view_vector(views, PoseVector::Zero()) {}

  PairMatrix A = PairMatrix::Zero();
  PairVector vector = PairVector::Zero();
  std::vector<Eigen::Matrix<double, kPairParameters, 6>> B;
  std::vector<PoseMatrix> C;
  std::vector<PoseVector> view_vector;
  double squared_residuals = 0.0;
  int residual_count = 0;
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Adds the corners that one camera saw in one view. Returns false if a corner has no projection.
bool AddCorners(const PairState& state, size_t view, bool is_right, const BoardView& seen_in,
                const CalibrationBoard& board, NormalEquations& equations) {
  const std::vector<BoardCorner>& corners = is_right ? seen_in.right : seen_in.left;
  const double weight = is_right ? seen_in.right_weight : seen_in.left_weight;
  const CameraModel& camera = is_right ? state.cameras.right : state.cameras.left;
  const Pose& X_LG = state.X_LG[view];
  const Pose& X_RL = state.cameras.X_RL;
  for (const BoardCorner& corner : corners) {
    const Vector3d turned = X_LG.rotation() * board.Corner(corner.id);
    const Vector3d p_LQ = turned + X_LG.translation();
    const auto seen = camera.Linearise(is_right ? X_RL * p_LQ : p_LQ);
    if (!seen) return false;
    Eigen::Matrix<double, 2, kPairParameters> by_pair =
        Eigen::Matrix<double, 2, kPairParameters>::Zero();
    Eigen::Matrix<double, 2, 6> by_view = seen->by_point * ByPose(turned);
    if (is_right) {
      by_pair.middleCols<kCameraParameters>(kRight) = seen->by_parameters;
      by_pair.rightCols<6>() = seen->by_point * ByPose(X_RL.rotation() * p_LQ);
      by_view = seen->by_point * X_RL.rotation() * ByPose(turned);
    } else {
      by_pair.leftCols<kCameraParameters>() = seen->by_parameters;
    }
    const Vector2d residual = corner.pixel - seen->pixel;
    equations.A += weight * by_pair.transpose() * by_pair;
    equations.vector += weight * by_pair.transpose() * residual;
    equations.B[view] += weight * by_pair.transpose() * by_view;
    equations.C[view] += weight * by_view.transpose() * by_view;
    equations.view_vector[view] += weight * by_view.transpose() * residual;
    equations.squared_residuals += weight * residual.squaredNorm();
    equations.residual_count += 2;
  }
  return true;
}

NormalEquations Linearise(const PairState& state, const std::vector<BoardView>& views,
                          const CalibrationBoard& board) {
  NormalEquations equations(views.size());
  for (size_t i = 0; i < views.size(); ++i) {
    if (!AddCorners(state, i, false, views[i], board, equations) ||
        !AddCorners(state, i, true, views[i], board, equations)) {
      equations.squared_residuals = kInfinity;
      break;
    }
  }
  return equations;
}

// Parameters that are not adjusted are eliminated by a unit row and column.
void Fix(int parameter, PairMatrix& matrix, PairVector& vector) {
  matrix.row(parameter).setZero();
  matrix.col(parameter).setZero();
  matrix(parameter, parameter) = 1.0;
  vector[parameter] = 0.0;
}

struct Reduced {
  PairMatrix matrix;
  PairVector vector;
};

// Schur complement of the board poses; `damping` multiplies the diagonal.
Reduced Reduce(const NormalEquations& equations, double damping, const AdjustmentOptions& options) {
  Reduced reduced{equations.A, equations.vector};
  reduced.matrix.diagonal() *= 1.0 + damping;
  for (size_t i = 0; i < equations.C.size(); ++i) {
    PoseMatrix C = equations.C[i];
    C.diagonal() *= 1.0 + damping;
    const Eigen::LDLT<PoseMatrix> factor(C);
    const Eigen::Matrix<double, 6, kPairParameters> weights =
        factor.solve(equations.B[i].transpose());
    reduced.matrix -= equations.B[i] * weights;
    reduced.vector -= weights.transpose() * equations.view_vector[i];
  }
  if (!options.free_k3) {
    Fix(kK3, reduced.matrix, reduced.vector);
    Fix(kRight + kK3, reduced.matrix, reduced.vector);
  }
  return reduced;
}

PairState Stepped(const PairState& state, const NormalEquations& equations, double damping,
                  const PairVector& step) {
  PairState stepped = state;
  StereoCalibration& cameras = stepped.cameras;
  cameras.left =
      cameras.left.WithParameters(cameras.left.ParameterVector() + step.head<kCameraParameters>());
  cameras.right = cameras.right.WithParameters(cameras.right.ParameterVector() +
                                               step.segment<kCameraParameters>(kRight));
  cameras.X_RL = Moved(cameras.X_RL, step.segment<6>(kRelative));
  for (size_t i = 0; i < stepped.X_LG.size(); ++i) {
    PoseMatrix C = equations.C[i];
    C.diagonal() *= 1.0 + damping;
    const PoseVector rest = equations.view_vector[i] - equations.B[i].transpose() * step;
    stepped.X_LG[i] = Moved(stepped.X_LG[i], C.ldlt().solve(rest));
  }
  return stepped;
}

// Tells whether the cameras are still valid after a step, i.e. whether the focal lengths are
// positive.
bool IsSensible(const PairState& state, const PairVector& step) {
  if (!step.allFinite()) return false;
  using CameraVector = Eigen::Matrix<double, kCameraParameters, 1>;
  const CameraVector left = state.cameras.left.ParameterVector() + step.head<kCameraParameters>();
  const CameraVector right =
      state.cameras.right.ParameterVector() + step.segment<kCameraParameters>(kRight);
  return left[0] > 0.0 && left[1] > 0.0 && right[0] > 0.0 && right[1] > 0.0;
}

PairMatrix Cofactor(const NormalEquations& equations, const AdjustmentOptions& options) {
  Reduced reduced = Reduce(equations, 0.0, options);
  // Scaled to a unit diagonal, so that pixels and radians can be compared.
  const PairVector scale = reduced.matrix.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const PairMatrix scaled = scale.asDiagonal() * reduced.matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<PairMatrix> spectrum(scaled);
  constexpr double kSmallestEigenvalue = 1e-11;
  if (!(spectrum.eigenvalues()[0] > kSmallestEigenvalue)) {
    throw InputError("calibration",
                     "the views do not determine the cameras: the board has to be tilted in "
                     "different directions, near and far");
  }
  PairMatrix cofactor = scale.asDiagonal() * spectrum.eigenvectors() *
                        spectrum.eigenvalues().cwiseInverse().asDiagonal() *
                        spectrum.eigenvectors().transpose() * scale.asDiagonal();
  if (!options.free_k3) {
    for (const int fixed : {kK3, kRight + kK3}) {
      cofactor.row(fixed).setZero();
      cofactor.col(fixed).setZero();
    }
  }
  return cofactor;
}

}  // namespace

PairVector PairError(const StereoCalibration& estimate, const StereoCalibration& truth) {
  PairVector error;
  error.head<kCameraParameters>() = truth.left.ParameterVector() - estimate.left.ParameterVector();
  error.segment<kCameraParameters>(kRight) =
      truth.right.ParameterVector() - estimate.right.ParameterVector();
  const Eigen::AngleAxisd turn(
      Matrix3d(truth.X_RL.rotation() * estimate.X_RL.rotation().transpose()));
  error.segment<3>(kRelative) = turn.angle() * turn.axis();
  error.tail<3>() = truth.X_RL.translation() - estimate.X_RL.translation();
  return error;
}

AdjustedPair AdjustPair(const PairState& start, const std::vector<BoardView>& views,
                        const CalibrationBoard& board, const AdjustmentOptions& options) {
  FENESTRA_CHECK(start.X_LG.size() == views.size(), "each view needs a board pose to start from");
  constexpr int kMostSteps = 100;
  constexpr double kSettled = 1e-12;  // Relative change of the sum of squares at convergence.
  PairState state = start;
  NormalEquations equations = Linearise(state, views, board);
  if (!std::isfinite(equations.squared_residuals)) {
    throw InputError("calibration", "the start lies outside the lens model's valid domain");
  }
  double damping = 1e-4;
  for (int i = 0; i < kMostSteps && damping < 1e12; ++i) {
    const Reduced reduced = Reduce(equations, damping, options);
    const PairVector step = reduced.matrix.ldlt().solve(reduced.vector);
    if (!IsSensible(state, step)) {
      damping *= 10.0;
      continue;
    }
    const PairState candidate = Stepped(state, equations, damping, step);
    NormalEquations next = Linearise(candidate, views, board);
    if (next.squared_residuals > equations.squared_residuals) {
      damping *= 10.0;
      continue;
    }
    const double gain = equations.squared_residuals - next.squared_residuals;
    state = candidate;
    equations = std::move(next);
    damping = std::max(1e-12, 0.1 * damping);
    if (gain <= kSettled * equations.squared_residuals) break;
  }
  const int free_parameters = kPairParameters - (options.free_k3 ? 0 : 2);
  const int unknowns = free_parameters + 6 * static_cast<int>(views.size());
  if (equations.residual_count <= unknowns) {
    throw InputError("calibration", "there are fewer corners than the cameras' parameters need");
  }
  return {.state = state,
          .squared_residuals = equations.squared_residuals,
          .residual_count = equations.residual_count,
          .unknown_count = unknowns,
          .cofactor = Cofactor(equations, options)};
}

}  // namespace fenestra
