#pragma once

#include <span>

namespace fenestra {

struct Interval {
  double lower = 0.0;
  double upper = 1.0;
};

/// Two-sided confidence interval of a binomial probability, exact in that it covers the true value
/// with at least the nominal confidence 1 - α whatever that value is:
///
///     lower = B⁻¹(α/2; k, n - k + 1)   (0 for k = 0)
///     upper = B⁻¹(1 - α/2; k + 1, n - k)   (1 for k = n)
///
/// with B⁻¹ the quantile of the beta distribution. [0, 1] for n = 0.
/// Source: C. J. Clopper and E. S. Pearson, "The use of confidence or fiducial limits illustrated
/// in the case of the binomial", Biometrika 26, 1934. Computed by Boost.Math.
/// Domain: 0 ≤ k = successes ≤ n = trials, 0 < confidence < 1; anything else fails a check.
Interval ClopperPearson(int successes, int trials, double confidence = 0.95);

/// One-sided confidence limits of a binomial probability, each of them with this confidence: each
/// end of a two-sided interval of confidence 1 - 2 α is a one-sided limit of confidence 1 - α.
/// Domain: as ClopperPearson, and confidence ≥ 0.5.
Interval OneSidedLimits(int successes, int trials, double confidence);

/// The p-quantile of a sample as the left-continuous inverse of its empirical distribution
/// function, x_(k) with k the smallest whole number such that k/n ≥ p: type 1 of R. J. Hyndman and
/// Y. Fan, "Sample quantiles in statistical packages", The American Statistician 50, 1996.
/// No interpolation, so that it is one of the observed values and +∞ (a miss) needs no care: with
/// n = 20 attempts the 0.95-quantile is the 19th smallest, and two misses make it infinite.
/// Domain: at least one value, none NaN, 0 < p ≤ 1.
double SampleQuantile(std::span<const double> values, double p);

// The sums below run in index order, so that equal samples give equal bits.

/// x̄ = Σ x_i / n.   Domain: n ≥ 1.
double Mean(std::span<const double> values);

/// √(Σ x_i² / n); of errors: RMSE² = bias² + (n - 1)/n s².   Domain: n ≥ 1.
double RootMeanSquare(std::span<const double> values);

/// s = √(Σ (x_i - x̄)² / (n - 1)), the square root of the unbiased variance.   Domain: n ≥ 2.
double StandardDeviation(std::span<const double> values);

/// s / √n: the standard deviation of x̄ over repetitions of the sample.   Domain: n ≥ 2.
double StandardErrorOfMean(std::span<const double> values);

}  // namespace fenestra
