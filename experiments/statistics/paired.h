#pragma once

#include <optional>
#include <span>

#include "experiments/statistics/moments.h"

namespace fenestra {

/// Trials that two detectors both tried, by who succeeded.
struct PairedCounts {
  int both = 0;
  int only_first = 0;
  int only_second = 0;
  int neither = 0;

  int pairs() const { return both + only_first + only_second + neither; }
  /// Rate of the first minus rate of the second.   Domain: pairs() ≥ 1.
  double difference() const { return static_cast<double>(only_first - only_second) / pairs(); }
};

/// McNemar's test, exact: the two-sided p-value of only_first ~ Bin(only_first + only_second, ½),
/// min(1, 2 P(X ≤ min)). Two detectors of equal rate give p ≤ α with probability at most α.
/// Source: Q. McNemar, Psychometrika 12, 1947. The same is the sign test of paired errors, with the
/// pairs that are nearer for one and the other.
double ExactMcNemar(int only_first, int only_second);

/// Interval of the difference of two rates from pairs, by inverting the score test.
/// Approximate: from 30 pairs on it covers with no less than 1.5 % under the nominal 95 %.
/// Source: T. Tango, "Equivalence test and confidence interval for the difference in proportions
/// for the paired-sample design", Statistics in Medicine 17, 1998. Domain: pairs() ≥ 1, else [-1,
/// 1].
Interval PairedDifferenceInterval(const PairedCounts& counts, double confidence = 0.95);

/// Two errors of every trial that both tried, in the same order; +∞ for a trial without an
/// estimate.
struct PairedErrors {
  std::span<const double> first;
  std::span<const double> second;
};

/// Comparison of paired errors; everything but the mean takes misses as they are.
struct ErrorComparison {
  int pairs = 0;
  int first_nearer = 0;
  int second_nearer = 0;  ///< The rest are equal, mostly two misses.
  double sign_test_p = 1.0;
  int both_finite = 0;
  /// Mean of first minus second over pairs that are both finite, with its t interval
  /// (MeanInterval); from two such pairs on.
  std::optional<double> mean_difference;
  std::optional<Interval> mean_difference_interval;
};

/// Domain: equally many, none NaN, none negative.
ErrorComparison CompareErrors(const PairedErrors& errors, double confidence = 0.95);

/// P-value against "the differences lie symmetrically around 0, cluster by cluster" for "they tend
/// to be above 0": the share of assignments of random signs to d_1 ... d_r whose sum is at least
/// Σ d_i. With differences of ±1 that is McNemar's test of discordant pairs, with ranks Wilcoxon's
/// signed-rank test.
///
/// All 2^r assignments for up to 16 differences that are not 0; else 19,999 random ones, drawn from
/// a fixed stream and counted together with the one observed, so that the test keeps its level
/// whatever r is (B. Phipson, G. Smyth, "Permutation p-values should never be zero", 2010). Above
/// 2000 differences, the normal limit of Σ d_i / √Σ d_i².
///
/// 1 without differences.
double SignFlipPValue(std::span<const double> differences);

}  // namespace fenestra
