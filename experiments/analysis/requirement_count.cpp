#include "experiments/analysis/requirement_count.h"

#include "core/system/check.h"
#include "experiments/statistics/moments.h"

namespace fenestra {

const char* ToString(RequirementVerdict verdict) {
  switch (verdict) {
    case RequirementVerdict::kHolds:
      return "holds";
    case RequirementVerdict::kFails:
      return "fails";
    case RequirementVerdict::kUndecided:
      return "undecided";
  }
  FENESTRA_CHECK(false, "verdict out of range");
}

void RequirementCount::Add(const TrialRecord& row) {
  ++trials_;
  if (!row.score.IsAttempt()) return;
  ++attempts_;
  if (row.score.outcome == Outcome::kHit) ++good_[0];
  const double error_mm = 1e3 * row.score.CentroidErrorOrInfinity_m();
  const Requirement& require = rule_.require;
  if (require.p50_error_mm && error_mm <= *require.p50_error_mm) ++good_[1];
  if (require.p95_error_mm && error_mm <= *require.p95_error_mm) ++good_[2];
}

std::array<RequirementCount::Demand, 3> RequirementCount::Demands() const {
  const Requirement& require = rule_.require;
  return {Demand{require.hit_rate, good_[0]}, Demand{require.p50_error_mm ? 0.50 : 0.0, good_[1]},
          Demand{require.p95_error_mm ? 0.95 : 0.0, good_[2]}};
}

RequirementVerdict RequirementCount::verdict() const {
  RequirementVerdict verdict = RequirementVerdict::kHolds;
  for (const Demand& demand : Demands()) {
    if (demand.share == 0.0) continue;
    const Interval limits = OneSidedLimits(demand.good, attempts_, rule_.confidence);
    if (limits.upper < demand.share) return RequirementVerdict::kFails;
    if (limits.lower < demand.share) verdict = RequirementVerdict::kUndecided;
  }
  return verdict;
}

bool RequirementCount::CanHoldAfter(int further) const {
  for (const Demand& demand : Demands()) {
    if (demand.share == 0.0) continue;
    const Interval best =
        OneSidedLimits(demand.good + further, attempts_ + further, rule_.confidence);
    if (best.lower < demand.share) return false;
  }
  return true;
}

}  // namespace fenestra
