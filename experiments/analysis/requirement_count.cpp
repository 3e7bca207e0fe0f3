#include "experiments/analysis/requirement_count.h"

namespace fenestra {

void RequirementCount::Add(const MetricRow& row) {
  tally_.Add(row);
  attempts_ += row.IsAttempt() ? 1 : 0;
}

std::optional<ConfidenceLimits> RequirementCount::LimitsOf(const Demand& demand) const {
  const Metric metric = FindMetric(demand.metric).value();
  return fenestra::LimitsOf(tally_, {metric, demand.value, !metric.IsShare()});
}

Verdict RequirementCount::verdict() const {
  Verdict verdict = Verdict::kHolds;
  for (const Demand& demand : rule_.require) {
    const auto limits = LimitsOf(demand);
    if (limits && limits->IsViolated(1.0 - rule_.confidence)) return Verdict::kViolated;
    if (!limits || !limits->Holds(rule_.confidence)) verdict = Verdict::kUndecided;
  }
  return verdict;
}

bool RequirementCount::CanHoldAfter(int further) const {
  for (const Demand& demand : rule_.require) {
    const auto limits = LimitsOf(demand);
    EffectiveCount best = limits ? *limits->share : EffectiveCount{0.0, 0.0, 0.0};
    for (double* part : {&best.successes, &best.trials, &best.clusters}) *part += further;
    if (LowerProportionLimit(best, rule_.confidence) < ShareOf(demand)) return false;
  }
  return true;
}

}  // namespace fenestra
