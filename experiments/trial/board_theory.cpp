#include "experiments/trial/board_theory.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "core/io/input_error.h"
#include "core/system/check.h"

namespace fenestra {
namespace {

using Eigen::MatrixXd;

constexpr int kRightCamera = kCameraParameters;
constexpr int kPairTurn = 2 * kCameraParameters;
constexpr int kPoseSteps = 6;

// Displacements of the corners by one standard deviation of each of the board's deviations [m]:
// element i belongs to corner i, and has a column for each deviation.
std::vector<MatrixXd> Displacements(const CalibrationBoard& board,
                                    const BoardTolerances& tolerances) {
  const int freedom = BoardShape::Freedom(board);
  std::vector<MatrixXd> of_corner(static_cast<size_t>(board.corner_count()), MatrixXd(3, freedom));
  for (int i = 0; i < freedom; ++i) {
    const BoardShape shape(board, tolerances, Eigen::VectorXd::Unit(freedom, i));
    for (int id = 0; id < board.corner_count(); ++id) {
      const Eigen::Vector3d drawn = board.Corner(id);
      of_corner[static_cast<size_t>(id)].col(i) = shape.At(drawn.head<2>()) - drawn;
    }
  }
  return of_corner;
}

// Derivatives of a view's pixels, two rows for each corner and camera.
struct ViewDerivatives {
  MatrixXd by_pair;
  MatrixXd by_pose;
  MatrixXd by_board;
};

ViewDerivatives DerivativesOf(const StereoCalibration& cameras, const Pose& X_LG,
                              const CalibrationBoard& board,
                              const std::vector<MatrixXd>& displacements) {
  const int rows = 4 * board.corner_count();
  ViewDerivatives d{.by_pair = MatrixXd::Zero(rows, kPairParameters),
                    .by_pose = MatrixXd::Zero(rows, kPoseSteps),
                    .by_board = MatrixXd::Zero(rows, displacements.front().cols())};
  const Eigen::Matrix3d R_RL = cameras.X_RL.rotation();
  for (int id = 0; id < board.corner_count(); ++id) {
    const Eigen::Vector3d turned = X_LG.rotation() * board.Corner(id);
    const Eigen::Vector3d p_LQ = turned + X_LG.translation();
    for (const bool is_right : {false, true}) {
      const CameraModel& camera = is_right ? cameras.right : cameras.left;
      const auto seen = camera.Linearise(is_right ? cameras.X_RL * p_LQ : p_LQ);
      if (!seen) throw InputError("calibration board", "a corner lies outside of a lens' domain");
      const int row = 4 * id + (is_right ? 2 : 0);
      d.by_pair.block<2, kCameraParameters>(row, is_right ? kRightCamera : 0) = seen->by_parameters;
      if (is_right) {
        d.by_pair.block<2, 3>(row, kPairTurn) = -seen->by_point * CrossMatrix(R_RL * p_LQ);
        d.by_pair.block<2, 3>(row, kPairTurn + 3) = seen->by_point;
      }
      const Eigen::Matrix<double, 2, 3> by_L =
          is_right ? Eigen::Matrix<double, 2, 3>(seen->by_point * R_RL) : seen->by_point;
      d.by_pose.block<2, 3>(row, 0) = -by_L * CrossMatrix(turned);
      d.by_pose.block<2, 3>(row, 3) = by_L;
      d.by_board.middleRows<2>(row) =
          by_L * X_LG.rotation() * displacements[static_cast<size_t>(id)];
    }
  }
  return d;
}

std::vector<int> FreeParameters(const AdjustmentOptions& adjustment) {
  std::vector<int> free;
  for (int i = 0; i < kPairParameters; ++i) {
    const bool is_k3 = i == kCameraParameters - 1 || i == 2 * kCameraParameters - 1;
    if (!is_k3 || adjustment.free_k3) free.push_back(i);
  }
  return free;
}

}  // namespace

MatrixXd BoardErrors(const StereoCalibration& cameras, const CalibrationBoard& board,
                     const std::vector<Pose>& X_LG, const CornerErrors& errors,
                     const AdjustmentOptions& adjustment) {
  const std::vector<MatrixXd> displacements = Displacements(board, errors.board);
  const std::vector<int> free = FreeParameters(adjustment);
  const auto count = static_cast<Eigen::Index>(free.size());
  MatrixXd normal = MatrixXd::Zero(count, count);
  MatrixXd coupling = MatrixXd::Zero(count, BoardShape::Freedom(board));
  for (const Pose& pose : X_LG) {
    const ViewDerivatives d = DerivativesOf(cameras, pose, board, displacements);
    const MatrixXd A = d.by_pair(Eigen::all, free);
    const MatrixXd QA =
        A - d.by_pose * (d.by_pose.transpose() * d.by_pose).ldlt().solve(d.by_pose.transpose() * A);
    normal += QA.transpose() * A;
    coupling += QA.transpose() * d.by_board;
  }
  // Scaled to a unit diagonal: the parameters' units differ by orders of magnitude.
  const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<MatrixXd> scaled(scale.asDiagonal() * normal * scale.asDiagonal());
  if (!scale.allFinite() || scaled.info() != Eigen::Success) {
    throw InputError("calibration", "the views do not determine the cameras");
  }
  const Eigen::Index deviations = coupling.cols();
  MatrixXd root(count, count + deviations);
  root.leftCols(count) =
      errors.noise_px *
      (scale.asDiagonal() * MatrixXd(scaled.matrixU().solve(MatrixXd::Identity(count, count))));
  root.rightCols(deviations) = scale.asDiagonal() * scaled.solve(scale.asDiagonal() * coupling);
  MatrixXd all = MatrixXd::Zero(kPairParameters, root.cols());
  all(free, Eigen::all) = root;
  return all;
}

MatrixXd BoardErrors(const StereoCalibration& design, BoardSessionOptions session, double noise_px,
                     const AdjustmentOptions& adjustment) {
  constexpr double kUsualBaseline_m = 0.35;
  session.board.square_m *= design.X_RL.translation().norm() / kUsualBaseline_m;
  std::vector<Pose> X_LG;
  for (int i = 0; i < session.views; ++i) {
    const RandomStream view = RandomStream(0).Child("view", static_cast<uint64_t>(i));
    const auto pose = DrawBoardPose(design, session, view);
    if (!pose) throw InputError("calibration board", "the cameras have no view of it in common");
    X_LG.push_back(*pose);
  }
  return BoardErrors(design, session.board, X_LG,
                     {.board = session.tolerances, .noise_px = noise_px}, adjustment);
}

StereoCalibration WithError(const StereoCalibration& truth, const PairVector& error) {
  const Pose& X_RL = truth.X_RL;
  const auto less = [&](const CameraModel& camera, int place) {
    return camera.WithParameters(camera.ParameterVector() -
                                 error.segment<kCameraParameters>(place));
  };
  return {.left = less(truth.left, 0),
          .right = less(truth.right, kRightCamera),
          .X_RL = Pose(RotationFromVector(-error.segment<3>(kPairTurn)) * X_RL.rotation(),
                       X_RL.translation() - error.tail<3>())};
}

}  // namespace fenestra
