#include "experiments/study/envelope_rule.h"

#include <algorithm>

#include "experiments/statistics/moments.h"
#include "experiments/study/metric.h"

namespace fenestra {

double ShareOf(const Demand& demand) {
  const Metric metric = FindMetric(demand.metric).value();
  return metric.IsShare() ? demand.value : metric.level;
}

bool AllGoodSuffice(const EnvelopeRule& rule, int attempts) {
  const double lower = OneSidedLimits(attempts, attempts, rule.confidence).lower;
  return std::all_of(rule.require.begin(), rule.require.end(),
                     [lower](const Demand& demand) { return lower >= ShareOf(demand); });
}

}  // namespace fenestra
