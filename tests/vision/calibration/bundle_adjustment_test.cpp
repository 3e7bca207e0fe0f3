#include "vision/calibration/bundle_adjustment.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "core/io/input_error.h"
#include "tests/vision/calibration/synthetic_boards.h"

namespace fenestra {
namespace {

using testing::ExamplePair;

// Boards before the pair, turned about both axes, whose corners are where the cameras project them.
struct Session {
  PairState truth;
  std::vector<BoardView> views;
};

Session ExactSession() {
  const CalibrationBoard board;
  Session session{.truth = {.cameras = ExamplePair(), .X_LG = {}}, .views = {}};
  const StereoCalibration& pair = session.truth.cameras;
  for (const double tilt_x : {-0.5, 0.1, 0.5}) {
    for (const double tilt_y : {-0.4, 0.3}) {
      const Eigen::Matrix3d R_LG = RotationFromVector({tilt_x, tilt_y, 0.1 * tilt_x});
      const Eigen::Vector3d p_GCentre(0.5 * board.width_m(), 0.5 * board.height_m(), 0.0);
      const Eigen::Vector3d p_LCentre(0.175 + 0.2 * tilt_y, 0.1 * tilt_x, 1.3 + 0.4 * tilt_y);
      const Pose X_LG(R_LG, p_LCentre - R_LG * p_GCentre);
      BoardView view;
      for (int id = 0; id < board.corner_count(); ++id) {
        const Eigen::Vector3d p_LQ = X_LG * board.Corner(id);
        const auto left = pair.left.Project(p_LQ);
        const auto right = pair.right.Project(pair.X_RL * p_LQ);
        if (left) view.left.push_back({.id = id, .pixel = *left});
        if (right) view.right.push_back({.id = id, .pixel = *right});
      }
      session.truth.X_LG.push_back(X_LG);
      session.views.push_back(std::move(view));
    }
  }
  return session;
}

CameraModel Changed(const CameraModel& camera, double by_px) {
  CameraParameters p = camera.parameters();
  p.fx_px += 2.0 * by_px;
  p.fy_px -= by_px;
  p.cx_px += by_px;
  p.distortion.k1 += 0.01 * by_px;
  return CameraModel(p);
}

// Where a rough calibration would start from.
PairState Displaced(PairState state) {
  state.cameras.left = Changed(state.cameras.left, 3.0);
  state.cameras.right = Changed(state.cameras.right, -2.0);
  state.cameras.X_RL =
      Pose(RotationFromVector({3e-3, -2e-3, 1e-3}), {0.004, -0.003, 0.002}) * state.cameras.X_RL;
  const Pose X_moved(RotationFromVector({0.02, -0.01, 0.02}), {0.01, 0.02, -0.02});
  for (Pose& X_LG : state.X_LG) X_LG = X_LG * X_moved;
  return state;
}

TEST(BundleAdjustment, NoiseFreeCornersGiveCamerasAndBoardsBack) {
  const Session session = ExactSession();
  const AdjustedPair pair = AdjustPair(Displaced(session.truth), session.views, {}, {});
  EXPECT_LT(pair.squared_residuals, 1e-10);
  const PairVector error = PairError(pair.state.cameras, session.truth.cameras);
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-5) << error.transpose();
  for (size_t i = 0; i < session.views.size(); ++i) {
    const Pose off = pair.state.X_LG[i].inverse() * session.truth.X_LG[i];
    EXPECT_LT(off.translation().norm(), 1e-6) << i;
    EXPECT_LT((off.rotation() - Eigen::Matrix3d::Identity()).norm(), 1e-6) << i;
  }
}

TEST(BundleAdjustment, ResidualsAndUnknownsAreCounted) {
  const Session session = ExactSession();
  int corners = 0;
  for (const BoardView& view : session.views) {
    corners += static_cast<int>(view.left.size() + view.right.size());
  }
  const AdjustedPair pair = AdjustPair(session.truth, session.views, {}, {});
  EXPECT_EQ(pair.residual_count, 2 * corners);
  EXPECT_EQ(pair.unknown_count, kPairParameters - 2 + 6 * 6);
  const AdjustedPair free = AdjustPair(session.truth, session.views, {}, {.free_k3 = true});
  EXPECT_EQ(free.unknown_count, kPairParameters + 6 * 6);
}

TEST(BundleAdjustment, K3IsKeptUnlessItIsFree) {
  const Session session = ExactSession();
  PairState start = Displaced(session.truth);
  CameraParameters left = start.cameras.left.parameters();
  left.distortion.k3 = 0.003;
  start.cameras.left = CameraModel(left);
  const AdjustedPair fixed = AdjustPair(start, session.views, {}, {});
  EXPECT_EQ(fixed.state.cameras.left.parameters().distortion.k3, 0.003);
  EXPECT_EQ(fixed.cofactor.row(8).norm(), 0.0);
  EXPECT_EQ(fixed.cofactor.col(kCameraParameters + 8).norm(), 0.0);
  const AdjustedPair free = AdjustPair(start, session.views, {}, {.free_k3 = true});
  EXPECT_NEAR(free.state.cameras.left.parameters().distortion.k3, 0.0, 1e-4);
  EXPECT_GT(free.cofactor(8, 8), 0.0);
}

TEST(BundleAdjustment, WeightsScaleTheCofactorAndNotTheResult) {
  const Session session = ExactSession();
  std::vector<BoardView> heavy = session.views;
  for (BoardView& view : heavy) {
    view.left_weight *= 4.0;
    view.right_weight *= 4.0;
  }
  const AdjustedPair once = AdjustPair(session.truth, session.views, {}, {});
  const AdjustedPair fourfold = AdjustPair(session.truth, heavy, {}, {});
  EXPECT_LT(PairError(once.state.cameras, fourfold.state.cameras).cwiseAbs().maxCoeff(), 1e-6);
  // The parameters' units differ by orders of magnitude, so each by its own deviation.
  const PairVector deviation = once.cofactor.diagonal().cwiseSqrt();
  for (int i = 0; i < kPairParameters; ++i) {
    for (int j = 0; j < kPairParameters; ++j) {
      EXPECT_NEAR(4.0 * fourfold.cofactor(i, j), once.cofactor(i, j),
                  1e-5 * deviation[i] * deviation[j]);
    }
  }
}

TEST(BundleAdjustment, AWeightOfNothingLeavesAViewsCameraOut) {
  const Session session = ExactSession();
  std::vector<BoardView> wrong = session.views;
  for (BoardCorner& corner : wrong[2].right) corner.pixel.x() += 25.0;
  wrong[2].right_weight = 1e-12;
  const AdjustedPair pair = AdjustPair(session.truth, wrong, {}, {});
  EXPECT_LT(PairError(pair.state.cameras, session.truth.cameras).cwiseAbs().maxCoeff(), 1e-3);
  // The twin: with its full weight it spoils the baseline.
  wrong[2].right_weight = 1.0;
  const AdjustedPair spoilt = AdjustPair(session.truth, wrong, {}, {});
  EXPECT_GT(PairError(spoilt.state.cameras, session.truth.cameras).cwiseAbs().maxCoeff(), 1e-2);
}

TEST(BundleAdjustment, TheCofactorIsSymmetricAndPositive) {
  const Session session = ExactSession();
  const AdjustedPair pair = AdjustPair(session.truth, session.views, {}, {.free_k3 = true});
  const PairVector scale = pair.cofactor.diagonal().cwiseSqrt().cwiseInverse();
  const PairMatrix correlation = scale.asDiagonal() * pair.cofactor * scale.asDiagonal();
  EXPECT_LT((correlation - correlation.transpose()).norm(), 1e-6);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<PairMatrix>(correlation).eigenvalues().minCoeff(), 0.0);
}

TEST(BundleAdjustment, ViewsThatDetermineNothingAreRefused) {
  const Session session = ExactSession();
  const PairState one{.cameras = session.truth.cameras, .X_LG = {session.truth.X_LG.front()}};
  BoardView few = session.views.front();
  few.left.resize(4);
  few.right.resize(4);
  EXPECT_THROW(AdjustPair(one, {few}, {}, {}), InputError);
}

}  // namespace
}  // namespace fenestra
