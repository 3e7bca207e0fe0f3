#pragma once

#include <limits>
#include <span>

#include "experiments/statistics/moments.h"

namespace fenestra {

/// Limits for means over rows that come in clusters. With common random numbers, the rows of one
/// replicate in several cells share their luck: not rows but clusters are independent of each
/// other.

/// One cluster's successes and rows.
struct ClusterCount {
  int successes = 0;
  int trials = 0;
};

/// Independent rows that would tell as much as the clusters do; not whole numbers in general.
///
///     p = Σ s_i / n,   V = r/(r-1) Σ (s_i - p n_i)² / n²,   n* = min(n, p (1 - p) / V · t²)
///     t = t(0.975; n-1) / t(0.975; r-1)
///
/// for r clusters with n rows; n* = r where p is 0 or 1, which says nothing of V. Clusters of one
/// row each give n* = n exactly.
/// Source: E. L. Korn, B. I. Graubard, "Confidence intervals for proportions with small expected
/// number of positive counts estimated from survey data", Survey Methodology 24, 1998.
struct EffectiveCount {
  double successes = 0.0;
  double trials = 0.0;
  /// r; unless it is stated, trials are taken for independent.
  double clusters = std::numeric_limits<double>::infinity();
};

EffectiveCount Effective(std::span<const ClusterCount> clusters);

/// The sums over clusters that the effective number of rows depends on: Σ 1, Σ n, Σ s, Σ s², Σ s n,
/// Σ n². Whole numbers, so that rows can be counted in any order. V n²/r·(r-1) = Σ s² - 2 p Σ s n +
/// p² Σ n².
struct ClusterMoments {
  double clusters = 0.0;
  double trials = 0.0;
  double successes = 0.0;
  double squared_successes = 0.0;
  double successes_by_trials = 0.0;
  double squared_trials = 0.0;

  /// One more success in a cluster that has `cluster.successes` without it.
  void AddSuccess(const ClusterCount& cluster);
  EffectiveCount Effective() const;
};

ClusterMoments MomentsOf(std::span<const ClusterCount> clusters);

/// One-sided Clopper–Pearson limits of a proportion: each is on its side of the true proportion
/// with at least the given probability if the rows are independent; sums of rows that differ in
/// their probabilities included (W. Hoeffding, Ann. Math. Stat. 27, 1956), and about that with
/// clusters. A few successes in a few clusters tell hardly more of V than none at all do; so no
/// limit is nearer to 0 or to 1 than it would be had r independent rows shown no success or no
/// failure, 1 - (1 - confidence)^(1/r) away from it. 0 and 1 without trials.
double LowerProportionLimit(const EffectiveCount& count, double confidence);
double UpperProportionLimit(const EffectiveCount& count, double confidence);

/// One cluster's sum over its rows, and what it is divided by: their number, or another weight > 0.
struct ClusterSum {
  double sum = 0.0;
  double weight = 0.0;
};

/// R = Σ y_i / Σ n_i over r clusters, and its standard error to first order,
/// √(r/(r-1) Σ (y_i - R n_i)²) / Σ n_i.   Domain: Σ n_i > 0.
struct ClusteredMean {
  double mean = 0.0;
  double standard_error = 0.0;  ///< +∞ for a single cluster.
  int clusters = 0;

  /// mean + t standard_error, t the quantile of Student's distribution with r - 1 degrees of
  /// freedom.
  double Quantile(double probability) const;
  /// mean ± t standard_error with this confidence. Domain: at least two clusters.
  Interval TwoSided(double confidence) const;
};

ClusteredMean MeanOf(std::span<const ClusterSum> clusters);

}  // namespace fenestra
