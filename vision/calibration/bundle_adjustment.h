#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/calibration.h"
#include "core/geometry/calibration_board.h"
#include "vision/calibration/board_finder.h"

namespace fenestra {

/// The board's corners that the two cameras of a pair saw at one moment; one side may be empty.
struct BoardView {
  std::vector<BoardCorner> left;
  std::vector<BoardCorner> right;
  /// Weights of the residuals: 1/σ² up to a common factor.
  double left_weight = 1.0;
  double right_weight = 1.0;
};

/// Parameters of a stereo pair, in this order: fx, fy, cx, cy [px], k1, k2, p1, p2, k3 of the left
/// camera; the same for the right camera; rotation X_RL as a local rotation vector (R = exp(δ) R₀)
/// [rad]; translation [m].
inline constexpr int kCameraParameters = 9;
inline constexpr int kPairParameters = 2 * kCameraParameters + 6;
using PairVector = Eigen::Matrix<double, kPairParameters, 1>;
using PairMatrix = Eigen::Matrix<double, kPairParameters, kPairParameters>;

/// Returns truth - estimate in the order of PairVector; the rotation's part is log(R_truth
/// R_estimateᵀ).
PairVector PairError(const StereoCalibration& estimate, const StereoCalibration& truth);

/// A calibration and the pose of the board in each view.
struct PairState {
  StereoCalibration cameras;
  std::vector<Pose> X_LG;
};

/// Least squares over both cameras' parameters, the pose between them and all board poses:
///
///     Σ w |pixel - project(X_CG p_GQ)|²
///
/// by Ceres: the Levenberg–Marquardt method with analytic derivatives; the board poses are eliminated
/// by their Schur complement.
struct AdjustedPair {
  PairState state;
  double squared_residuals;  ///< Weighted sum; [px²] with unit weights.
  int residual_count;        ///< Two for each corner.
  int unknown_count;         ///< Free parameters and six for each view.
  /// Inverse information of the free parameters with unit variance of unit weight; rows and
  /// columns of fixed parameters are 0. The covariance is σ² times it.
  PairMatrix cofactor;

  /// Variance of one coordinate of a corner of unit weight, estimated from the residuals [px²].
  double variance() const {
    return squared_residuals / static_cast<double>(residual_count - unknown_count);
  }
  PairMatrix covariance() const { return variance() * cofactor; }
};

struct AdjustmentOptions {
  bool free_k3 = false;  ///< If false, both cameras keep their k3.
};

/// Adjusts all parameters to the views. Each view must have at least one corner. Throws InputError
/// if the views do not determine the parameters.
AdjustedPair AdjustPair(const PairState& start, const std::vector<BoardView>& views,
                        const CalibrationBoard& board, const AdjustmentOptions& options);

}  // namespace fenestra
