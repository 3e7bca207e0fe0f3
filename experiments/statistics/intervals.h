#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/random/random_stream.h"
#include "experiments/statistics/moments.h"

namespace fenestra {

/// Confidence interval of the p-quantile ξ of the distribution that the values were drawn from, by
/// order statistics: [x_(l), x_(u)] with
///
///     l the largest rank with P(Bin(n, p) < l) ≤ α/2   (-∞ for l = 0)
///     u the smallest rank with P(Bin(n, p) ≥ u) ≤ α/2   (+∞ if there is none)
///
/// and α = 1 - confidence. Covers ξ with at least the confidence for every distribution, those with
/// atoms and with +∞ (a miss) among them.
/// Source: H. A. David and H. N. Nagaraja, "Order Statistics", 3rd ed. 2003, section 7.1.
/// Domain: none NaN, 0 < p < 1; without values (-∞, +∞).
Interval QuantileInterval(std::span<const double> values, double p, double confidence = 0.95);

/// x̄ ± t s / √n with Student's t of n - 1 degrees of freedom. Exact for normal values, otherwise
/// for large n (within 2 % of nominal from n = 30 on unless the values are very skewed).
/// nullopt for n < 2.
std::optional<Interval> MeanInterval(std::span<const double> values, double confidence = 0.95);

/// The numbers of trials at which a sequential procedure looks at its data: `first`, then each half
/// as many again, and at last `most`. Fixed beforehand, so that what was seen cannot move them.
/// Domain: 1 ≤ first, 1 ≤ most.
std::vector<int> Looks(int first, int most);

/// The confidence of each look's interval with which all intervals of `looks` looks cover together
/// with at least `confidence`, whatever rule says when to stop:
///
///     1 - (1 - confidence) / looks
///
/// (Bonferroni; the error is spent in equal parts.) So the interval at which a study stopped covers
/// with that confidence, too. Exact intervals stay exact in this sense.
double LookConfidence(double confidence, int looks);

}  // namespace fenestra
