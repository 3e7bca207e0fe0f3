#include "experiments/study/distribution.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <cmath>

#include "core/system/check.h"

namespace fenestra {
namespace {

using boost::math::cdf;
using boost::math::complement;
using boost::math::normal;
using boost::math::quantile;

double QuantileOf(const UniformDistribution& d, double p) {
  return d.min + p * (d.max - d.min);
}

double QuantileOf(const LogUniformDistribution& d, double p) {
  return d.min * std::exp(p * std::log(d.max / d.min));
}

double QuantileOf(const TriangularDistribution& d, double p) {
  return quantile(boost::math::triangular_distribution<double>(d.min, d.mode, d.max), p);
}

// F(x) = (Φ(x) − Φ(a)) / (Φ(b) − Φ(a)), inverted. Limits above the mean are mirrored below it,
// since Φ has no digits left near 1.
double QuantileOf(const TruncatedNormalDistribution& d, double p) {
  if (d.min > d.mean) {
    return -QuantileOf(TruncatedNormalDistribution{-d.mean, d.sd, -d.max, -d.min}, 1.0 - p);
  }
  if (p <= 0.0) return d.min;
  if (p >= 1.0) return d.max;
  const normal untruncated(d.mean, d.sd);
  const double below = cdf(untruncated, d.min);
  return quantile(untruncated, below + p * NormalMass(d.mean, d.sd, d.min, d.max));
}

}  // namespace

double Quantile(const Distribution& distribution, double p) {
  FENESTRA_CHECK(p >= 0.0 && p <= 1.0, "a quantile needs a probability");
  const double x = std::visit([p](const auto& d) { return QuantileOf(d, p); }, distribution);
  // Rounding may carry a value past the ends.
  return std::clamp(x, Lowest(distribution), Highest(distribution));
}

double Lowest(const Distribution& distribution) {
  return std::visit([](const auto& d) { return d.min; }, distribution);
}

double Highest(const Distribution& distribution) {
  return std::visit([](const auto& d) { return d.max; }, distribution);
}

double NormalMass(double mean, double sd, double min, double max) {
  const normal untruncated(mean, sd);
  if (min > mean) return cdf(complement(untruncated, min)) - cdf(complement(untruncated, max));
  return cdf(untruncated, max) - cdf(untruncated, min);
}

}  // namespace fenestra
