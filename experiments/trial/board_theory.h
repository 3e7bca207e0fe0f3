#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/calibration.h"
#include "sim/stereo/board_session.h"
#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// What a calibration with boards does not know, besides the cameras and where the boards stood.
struct CornerErrors {
  BoardTolerances board;  ///< Of the one board that all views show.
  double noise_px = 0.0;  ///< Of each corner's coordinate in each picture.
};

/// The error (PairError) of least squares with views of one board, to first order and without a
/// picture: S such that e = S z with independent standard normal z, so that cov e = S Sᵀ.
///
/// Residuals are r = A e + P p + B s + n, with the pair's error e, errors p of the boards' poses,
/// the board's deviations s and the corners' noise n. With Q = I - P P⁺, N = Aᵀ Q A and M = Aᵀ Q B,
///
///     e = -N⁻¹ Aᵀ Q (B s + n),     cov e = σ_n² N⁻¹ + N⁻¹ M Σ_s Mᵀ N⁻¹.
///
/// An adjustment states σ² N⁻¹ of itself, with the residuals' variance σ²: as if each corner of
/// each picture erred alone. So it states too little where the board errs.
///
/// X_LG: poses of the board. Throws InputError if they do not determine the cameras.
Eigen::MatrixXd BoardErrors(const StereoCalibration& cameras, const CalibrationBoard& board,
                            const std::vector<Pose>& X_LG, const CornerErrors& errors,
                            const AdjustmentOptions& adjustment);

/// The same for poses that a session draws before the cameras as designed, with a board that is
/// scaled with their baseline (`session.board` is for 0.35 m), so that both cameras see it.
Eigen::MatrixXd BoardErrors(const StereoCalibration& design, BoardSessionOptions session,
                            double noise_px, const AdjustmentOptions& adjustment);

/// The calibration from which `truth` differs by `error`: PairError(WithError(truth, e), truth) =
/// e.
StereoCalibration WithError(const StereoCalibration& truth, const PairVector& error);

}  // namespace fenestra
