#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/random/random_stream.h"
#include "experiments/statistics/moments.h"

namespace fenestra {

/// Sobol's indices of one cause: shares of the variance of y.
struct SobolIndex {
  double first = 0.0;  ///< Var E[y | cause] / Var y: what it explains by itself.
  Interval first_interval;
  double total = 0.0;  ///< E Var[y | all other causes] / Var y: what is lost without its spread.
  Interval total_interval;
};

/// Estimates from a pick-freeze design of k causes, rows of y_A, y_B, y_1 … y_k (the columns of
/// PickFreezePlace; y_i has cause i of B and the others of A), with ρ the sample correlation:
///
///     first_i = ρ(y_B, y_i),   total_i = 1 - ρ(y_A, y_i)
///
/// Being correlations, they do not depend on the mean of y, which would blow up the error of
/// estimates made of raw products. Intervals are percentiles of 500 bootstrap samples of whole
/// rows. Approximate: from 200 rows on they cover within 5 % of the nominal 95 %; first-order
/// indices near 0 may come out below. Source: J.-M. Martinez, "Analyse de sensibilité globale par
/// décomposition de la variance", GdR MascotNum 2011; computed by OpenTURNS. Domain: causes must be
/// independent. nullopt for less than kFewestRows rows or constant y.
std::optional<std::vector<SobolIndex>> SobolIndices(const Eigen::MatrixXd& rows,
                                                    const RandomStream& resampling,
                                                    double confidence = 0.95);

inline constexpr int kFewestRows = 10;

}  // namespace fenestra
