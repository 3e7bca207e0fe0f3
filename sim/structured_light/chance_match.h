#pragma once

namespace fenestra {

/// The greatest of N independent normal numbers of mean 0 and deviation σ: P(best < x) = Φ(x/σ)^N.
struct ChanceMatch {
  double deviation;
  double places;  ///< N ≥ 1.

  /// Drawn by the standard normal number ν, if it is more than `enough`; else -1.
  float Best(float enough, float nu) const;
};

/// Φ, the distribution of a standard normal number.
double NormalShare(double x);

/// Σ exp(-k²/w) over all pixels k of a plane.
double SumOfGaussian(double w);

}  // namespace fenestra
