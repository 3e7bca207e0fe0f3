#pragma once

#include <variant>

namespace fenestra {

/// Constant density on [min, max]; min < max.
struct UniformDistribution {
  double min;
  double max;
  bool operator==(const UniformDistribution&) const = default;
};

/// The logarithm is uniform on [ln min, ln max]; 0 < min < max.
struct LogUniformDistribution {
  double min;
  double max;
  bool operator==(const LogUniformDistribution&) const = default;
};

/// Density rising linearly from min to mode and falling to max; min ≤ mode ≤ max, min < max.
struct TriangularDistribution {
  double min;
  double mode;
  double max;
  bool operator==(const TriangularDistribution&) const = default;
};

/// A normal distribution of this mean and sd, given that the value lies in [min, max];
/// sd > 0, min < max, both finite, and at least kLeastNormalMass of the normal between them.
/// Mean and sd are those of the normal before it is truncated.
struct TruncatedNormalDistribution {
  double mean;
  double sd;
  double min;
  double max;
  bool operator==(const TruncatedNormalDistribution&) const = default;
};

/// With less probability than this between the limits the quantiles would lose digits.
inline constexpr double kLeastNormalMass = 1e-6;

/// A distribution of a factor's values. All are bounded: a draw can never leave a factor's range.
using Distribution = std::variant<UniformDistribution, LogUniformDistribution,
                                  TriangularDistribution, TruncatedNormalDistribution>;

/// Inverse of the cumulative distribution function: the smallest x with P(X ≤ x) ≥ p, for
/// 0 ≤ p ≤ 1. Quantile(d, 0) and Quantile(d, 1) are the ends of the support. Increases with p.
double Quantile(const Distribution& distribution, double p);

double Lowest(const Distribution& distribution);
double Highest(const Distribution& distribution);

/// P(min ≤ X ≤ max) of a normal variate that is not truncated, with a small relative error even
/// in the far tails. The limits may be infinite.
double NormalMass(double mean, double sd, double min, double max);

}  // namespace fenestra
