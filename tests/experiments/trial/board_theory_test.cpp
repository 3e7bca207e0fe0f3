#include "experiments/trial/board_theory.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

const StereoCalibration kDesign = DesignOf(StereoRigOptions());
const CalibrationBoard kBoard;
const CornerErrors kErrors{.board = {}, .noise_px = 0.03};
const AdjustmentOptions kFreeK3{.free_k3 = true};

std::vector<Pose> Poses(int count) {
  std::vector<Pose> X_LG;
  for (int i = 0; i < count; ++i) {
    const RandomStream view = RandomStream(4).Child("view", static_cast<uint64_t>(i));
    X_LG.push_back(DrawBoardPose(kDesign, {}, view).value());
  }
  return X_LG;
}

// Corners of a board as made, with noise.
std::vector<BoardView> Views(const std::vector<Pose>& X_LG, const RandomStream& stream) {
  const BoardShape shape(kBoard, kErrors.board, stream.Child("board"));
  std::vector<BoardView> views;
  for (size_t i = 0; i < X_LG.size(); ++i) {
    const RandomStream noise = stream.Child("noise", i);
    BoardView view;
    for (int id = 0; id < kBoard.corner_count(); ++id) {
      const Eigen::Vector3d p_LQ = X_LG[i] * shape.At(kBoard.Corner(id).head<2>());
      const auto index = 4 * static_cast<uint64_t>(id);
      const auto noise_at = [&](uint64_t k) -> Eigen::Vector2d {
        return kErrors.noise_px *
               Eigen::Vector2d(noise.Normal(index + k), noise.Normal(index + k + 1));
      };
      view.left.push_back({id, kDesign.left.Project(p_LQ).value() + noise_at(0)});
      view.right.push_back({id, kDesign.right.Project(kDesign.X_RL * p_LQ).value() + noise_at(2)});
    }
    views.push_back(view);
  }
  return views;
}

double NormalisedSquare(const PairVector& error, const PairMatrix& covariance) {
  const PairVector scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const PairVector scaled = scale.cwiseProduct(error);
  return scaled.dot(
      PairMatrix(scale.asDiagonal() * covariance * scale.asDiagonal()).ldlt().solve(scaled));
}

// Adjustments of 40 boards: errors in units of the covariance are χ² with 24 degrees of freedom
// each if it is right. Two-sided, wrong once in 10⁴.
TEST(BoardTheory, IsWhatTheAdjustmentOfBoardsAsMadeErrsBy) {
  constexpr int kBoards = 40;
  const std::vector<Pose> X_LG = Poses(10);
  const Eigen::MatrixXd errors = BoardErrors(kDesign, kBoard, X_LG, kErrors, kFreeK3);
  const PairMatrix covariance = errors * errors.transpose();
  double sum = 0.0;
  double stated = 0.0;
  for (uint64_t seed = 0; seed < kBoards; ++seed) {
    const AdjustedPair pair = AdjustPair({.cameras = kDesign, .X_LG = X_LG},
                                         Views(X_LG, RandomStream(seed)), kBoard, kFreeK3);
    const PairVector error = PairError(pair.state.cameras, kDesign);
    sum += NormalisedSquare(error, covariance);
    stated += NormalisedSquare(error, pair.covariance());
  }
  const boost::math::chi_squared law(kBoards * kPairParameters);
  const auto holds = [&](double value) {
    return value > quantile(law, 5e-5) && value < quantile(complement(law, 5e-5));
  };
  EXPECT_TRUE(holds(sum)) << sum / kBoards;
  // The twins: a covariance 1.4 times too large or too small, and the one that the adjustment
  // states, which takes the board for its drawing.
  EXPECT_FALSE(holds(1.4 * sum));
  EXPECT_FALSE(holds(sum / 1.4));
  EXPECT_FALSE(holds(stated)) << stated / kBoards;
}

TEST(BoardTheory, OfABoardAsDrawnIsWhatTheAdjustmentStates) {
  const std::vector<Pose> X_LG = Poses(6);
  const Eigen::MatrixXd errors =
      BoardErrors(kDesign, kBoard, X_LG, {.board = kAsDrawn, .noise_px = 1.0}, {});
  std::vector<BoardView> views;
  for (const Pose& pose : X_LG) {
    BoardView view;
    for (int id = 0; id < kBoard.corner_count(); ++id) {
      const Eigen::Vector3d p_LQ = pose * kBoard.Corner(id);
      view.left.push_back({id, kDesign.left.Project(p_LQ).value()});
      view.right.push_back({id, kDesign.right.Project(kDesign.X_RL * p_LQ).value()});
    }
    views.push_back(view);
  }
  const PairMatrix cofactor =
      AdjustPair({.cameras = kDesign, .X_LG = X_LG}, views, kBoard, {}).cofactor;
  const PairMatrix covariance = errors * errors.transpose();
  for (int i = 0; i < kPairParameters; ++i) {
    // Both invert matrices whose condition is some 10⁸.
    EXPECT_NEAR(covariance(i, i), cofactor(i, i), 1e-5 * cofactor(i, i)) << i;
  }
}

TEST(BoardTheory, AnErrorLeadsFromTheTruthToTheEstimateAndBack) {
  PairVector error = PairVector::Constant(1e-3);
  error.head<4>().setConstant(0.5);
  EXPECT_LT((PairError(WithError(kDesign, error), kDesign) - error).norm(), 1e-12);
}

TEST(BoardTheory, ScalesWithTheRig) {
  StereoRigOptions longer;
  longer.baseline_m *= 3.0;
  const auto errors = [](const StereoRigOptions& rig) {
    return BoardErrors(DesignOf(rig), BoardSessionOptions(), 0.05, kFreeK3);
  };
  const Eigen::VectorXd usual = errors(StereoRigOptions()).rowwise().norm();
  const Eigen::VectorXd larger = errors(longer).rowwise().norm();
  for (int i = 0; i < kPairParameters; ++i) {
    const double scale = i < kPairParameters - 3 ? 1.0 : 3.0;  // Only the translation is a length.
    EXPECT_NEAR(larger[i], scale * usual[i], 1e-6 * scale * usual[i]) << i;
  }
}

TEST(BoardTheory, TooFewViewsAreRefused) {
  EXPECT_THROW(BoardErrors(kDesign, kBoard, {}, kErrors, kFreeK3), InputError);
}

}  // namespace
}  // namespace fenestra
