#include "experiments/statistics/clustered_statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <limits>

#include "core/system/check.h"

namespace fenestra {
namespace {

double StudentQuantile(double degrees, double probability) {
  return boost::math::quantile(boost::math::students_t(degrees), probability);
}

}  // namespace

EffectiveCount Effective(std::span<const ClusterCount> clusters) {
  double successes = 0.0;
  double n = 0.0;
  double r = 0.0;
  for (const ClusterCount& cluster : clusters) {
    FENESTRA_CHECK(0 <= cluster.successes && cluster.successes <= cluster.trials, "more than all");
    successes += cluster.successes;
    n += cluster.trials;
    r += cluster.trials > 0 ? 1.0 : 0.0;
  }
  if (r == n) return {successes, n};
  const double p = successes / n;
  double sum = 0.0;
  for (const ClusterCount& cluster : clusters) {
    const double residual = cluster.successes - p * cluster.trials;
    sum += residual * residual;
  }
  const double variance = r > 1.0 ? r / (r - 1.0) * sum / (n * n) : 0.0;
  if (!(variance > 0.0)) return {p * r, r};
  const double t = StudentQuantile(n - 1.0, 0.975) / StudentQuantile(r - 1.0, 0.975);
  const double effective = std::min(n, p * (1.0 - p) / variance * t * t);
  return {p * effective, effective};
}

double LowerProportionLimit(const EffectiveCount& count, double confidence) {
  if (!(count.successes > 0.0)) return 0.0;
  return boost::math::ibeta_inv(count.successes, count.trials - count.successes + 1.0,
                                1.0 - confidence);
}

double UpperProportionLimit(const EffectiveCount& count, double confidence) {
  return 1.0 - LowerProportionLimit({count.trials - count.successes, count.trials}, confidence);
}

double ClusteredMean::Quantile(double probability) const {
  if (clusters < 2) {
    return probability < 0.5 ? -std::numeric_limits<double>::infinity()
                             : std::numeric_limits<double>::infinity();
  }
  return mean + StudentQuantile(clusters - 1.0, probability) * standard_error;
}

ClusteredMean MeanOf(std::span<const ClusterSum> clusters) {
  double sum = 0.0;
  double n = 0.0;
  int r = 0;
  for (const ClusterSum& cluster : clusters) {
    sum += cluster.sum;
    n += cluster.rows;
    r += cluster.rows > 0 ? 1 : 0;
  }
  FENESTRA_CHECK(n > 0.0, "no rows");
  ClusteredMean result{
      .mean = sum / n, .standard_error = std::numeric_limits<double>::infinity(), .clusters = r};
  if (r < 2) return result;
  double squares = 0.0;
  for (const ClusterSum& cluster : clusters) {
    const double residual = cluster.sum - result.mean * cluster.rows;
    squares += residual * residual;
  }
  result.standard_error = std::sqrt(r / (r - 1.0) * squares) / n;
  return result;
}

}  // namespace fenestra
