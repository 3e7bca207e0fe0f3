#include "sim/structured_light/chance_match.h"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

// The x that a standard normal number exceeds with this probability.
double NormalWithTail(double probability) {
  using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  return std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * probability, InDouble());
}

}  // namespace

double NormalShare(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

double SumOfGaussian(double w) {
  double along = 1.0;
  for (int k = 1; k < 8; ++k) along += 2.0 * std::exp(-k * k / w);
  return along * along;
}

float ChanceMatch::Best(float enough, float nu) const {
  const double least = static_cast<double>(enough) / deviation;
  // Spares most blocks the functions: 1000 Φ(-5) = Φ(-3.4).
  if (least > 5.0 && nu < 3.4f && places < 1000.0) return -1.0f;
  const double share = NormalShare(static_cast<double>(nu));
  if (share <= std::pow(NormalShare(least), places)) return -1.0f;
  // The upper tail: 1 - Φ(x/σ) = 1 - Φ(ν)^(1/N).
  const double tail = -std::expm1(std::log(share) / places);
  return static_cast<float>(deviation * NormalWithTail(tail));
}

}  // namespace fenestra
