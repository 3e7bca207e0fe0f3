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
  return MomentsOf(clusters).Effective();
}

ClusterMoments MomentsOf(std::span<const ClusterCount> clusters) {
  ClusterMoments moments;
  for (const ClusterCount& cluster : clusters) {
    FENESTRA_CHECK(0 <= cluster.successes && cluster.successes <= cluster.trials, "more than all");
    const double n = cluster.trials;
    const double s = cluster.successes;
    moments.clusters += n > 0.0 ? 1.0 : 0.0;
    moments.trials += n;
    moments.successes += s;
    moments.squared_successes += s * s;
    moments.successes_by_trials += s * n;
    moments.squared_trials += n * n;
  }
  return moments;
}

void ClusterMoments::AddSuccess(const ClusterCount& cluster) {
  successes += 1.0;
  squared_successes += 2.0 * cluster.successes + 1.0;
  successes_by_trials += cluster.trials;
}

EffectiveCount ClusterMoments::Effective() const {
  const double r = clusters;
  const double n = trials;
  if (r == n) return {successes, n, r};
  const double p = successes / n;
  // Where all clusters have the same share, rounding must not make a scatter of it.
  const double sum = squared_successes - 2.0 * p * successes_by_trials + p * p * squared_trials;
  const bool scatter = r > 1.0 && sum > 1e-12 * squared_trials;
  if (!scatter) return {p * r, r, r};
  const double variance = r / (r - 1.0) * sum / (n * n);
  const double t = StudentQuantile(n - 1.0, 0.975) / StudentQuantile(r - 1.0, 0.975);
  const double effective = std::min(n, p * (1.0 - p) / variance * t * t);
  return {p * effective, effective, r};
}

double LowerProportionLimit(const EffectiveCount& count, double confidence) {
  if (!(count.successes > 0.0)) return 0.0;
  const double limit = boost::math::ibeta_inv(count.successes, count.trials - count.successes + 1.0,
                                              1.0 - confidence);
  return std::min(limit, std::pow(1.0 - confidence, 1.0 / count.clusters));
}

double UpperProportionLimit(const EffectiveCount& count, double confidence) {
  const EffectiveCount failures{count.trials - count.successes, count.trials, count.clusters};
  return 1.0 - LowerProportionLimit(failures, confidence);
}

double ClusteredMean::Quantile(double probability) const {
  if (clusters < 2) {
    return probability < 0.5 ? -std::numeric_limits<double>::infinity()
                             : std::numeric_limits<double>::infinity();
  }
  return mean + StudentQuantile(clusters - 1.0, probability) * standard_error;
}

Interval ClusteredMean::TwoSided(double confidence) const {
  FENESTRA_CHECK(clusters >= 2, "one cluster limits nothing");
  const double half =
      StudentQuantile(clusters - 1.0, 1.0 - (1.0 - confidence) / 2.0) * standard_error;
  return {.lower = mean - half, .upper = mean + half};
}

ClusteredMean MeanOf(std::span<const ClusterSum> clusters) {
  double sum = 0.0;
  double n = 0.0;
  int r = 0;
  for (const ClusterSum& cluster : clusters) {
    sum += cluster.sum;
    n += cluster.weight;
    r += cluster.weight > 0.0 ? 1 : 0;
  }
  FENESTRA_CHECK(n > 0.0, "no rows");
  ClusteredMean result{
      .mean = sum / n, .standard_error = std::numeric_limits<double>::infinity(), .clusters = r};
  if (r < 2) return result;
  double squares = 0.0;
  for (const ClusterSum& cluster : clusters) {
    const double residual = cluster.sum - result.mean * cluster.weight;
    squares += residual * residual;
  }
  // √r/n as 1/√r over n/r: with clusters of one row each, the bits of StandardErrorOfMean.
  result.standard_error =
      std::sqrt(squares / (r - 1.0)) / std::sqrt(static_cast<double>(r)) / (n / r);
  return result;
}

}  // namespace fenestra
