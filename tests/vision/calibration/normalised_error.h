#pragma once

#include <Eigen/Cholesky>

#include "vision/calibration/bundle_adjustment.h"

namespace fenestra::testing {

inline constexpr int kFreeParameters = kPairParameters - 2;  ///< All but the two k3.

/// eᵀ Σ⁻¹ e over the free parameters.
inline double NormalisedSquaredError(const PairVector& error, const PairMatrix& covariance) {
  // Scaled to a unit diagonal, since the parameters' units differ by orders of magnitude; fixed
  // parameters have neither error nor covariance.
  const PairVector deviation = covariance.diagonal().cwiseSqrt();
  Eigen::Matrix<double, kFreeParameters, 1> e;
  Eigen::Matrix<double, kFreeParameters, kFreeParameters> correlation;
  int row = 0;
  for (int i = 0; i < kPairParameters; ++i) {
    if (!(deviation[i] > 0.0)) continue;
    e[row] = error[i] / deviation[i];
    int column = 0;
    for (int j = 0; j < kPairParameters; ++j) {
      if (!(deviation[j] > 0.0)) continue;
      correlation(row, column++) = covariance(i, j) / (deviation[i] * deviation[j]);
    }
    ++row;
  }
  return e.dot(correlation.ldlt().solve(e));
}

}  // namespace fenestra::testing
