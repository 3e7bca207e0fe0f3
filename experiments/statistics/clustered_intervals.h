#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/random/random_stream.h"
#include "experiments/statistics/clustered_statistics.h"
#include "experiments/statistics/moments.h"

namespace fenestra {

/// Two-sided confidence intervals of figures whose rows come in clusters: rows of one cluster may
/// depend on each other in any way, clusters are independent. With one row in every cluster each is
/// the textbook's interval of independent rows, to the last bit.

/// A row's value and the cluster that it belongs to, counted from 0.
struct ClusteredValue {
  double value = 0.0;
  size_t cluster = 0;
};

/// Interval of the p-quantile by inverting limits of shares: its lower end is the least observed x
/// for which the share of values ≤ x may still be p, its upper end the least one for which that
/// share is shown to be at least p,
///
///     lower = min {x : U(F(x)) ≥ p},   upper = min {x : L(F(x)) ≥ p}
///
/// with L and U the one-sided limits of a clustered share (LowerProportionLimit), each with the
/// confidence 1 - α/2. Ends are infinite where there is no such x, or none below it.
/// With clusters of one row each this is QuantileInterval. Source: R. S. Woodruff, "Confidence
/// intervals for medians and other position measures", JASA 47, 1952, with the limits of Korn and
/// Graubard 1998. Domain: none NaN, +∞ is a miss, 0 < p < 1; without values (-∞, +∞).
Interval ClusteredQuantileInterval(std::span<const ClusteredValue> values, double p,
                                   double confidence = 0.95);

/// Interval of √E[x²], of which RootMeanSquare is the estimate, by a studentised bootstrap of
/// ln m, m = Σ x²/n: with s² the variance of x² and τ = (ln m* - ln m) / (s* / (m* √n)) over
/// resamples,
///
///     ln m - τ_(1-α/2) s/(m √n)  ≤  ln E[x²]  ≤  ln m - τ_(α/2) s/(m √n)
///
/// The logarithm makes the variance of the estimate nearly free of its mean, without which skewed
/// squares are covered too seldom. From kManyForRms values on τ is taken for normal. Approximate:
/// within 2 % of nominal for normal values from n = 10 on.   nullopt for n < kFewestForRms, and
/// where all squares are equal. Source: B. Efron and R. J. Tibshirani, "An Introduction to the
/// Bootstrap", 1993, chapter 12. Domain: finite values. Equal values and streams give equal bits.
std::optional<Interval> RootMeanSquareInterval(std::span<const double> values,
                                               const RandomStream& resampling,
                                               double confidence = 0.95);

inline constexpr int kFewestForRms = 5;
inline constexpr int kManyForRms = 1000;

/// Interval of √(E[Σ x²] / E[Σ w]), of which √(Σ sum / Σ weight) is the estimate, by the
/// studentised bootstrap of RootMeanSquareInterval over whole clusters, given by their sums of
/// squares. nullopt for fewer than kFewestForRms clusters, and where nothing varies. Domain: finite
/// sums, weights > 0.
std::optional<Interval> ClusteredRmsInterval(std::span<const ClusterSum> clusters,
                                             const RandomStream& resampling,
                                             double confidence = 0.95);

}  // namespace fenestra
