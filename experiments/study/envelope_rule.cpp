#include "experiments/study/envelope_rule.h"

#include <algorithm>

#include "experiments/statistics/moments.h"

namespace fenestra {

bool AllGoodSuffice(const EnvelopeRule& rule, int attempts) {
  const Requirement& require = rule.require;
  const double share = std::max(
      {require.hit_rate, require.p50_error_mm ? 0.50 : 0.0, require.p95_error_mm ? 0.95 : 0.0});
  return OneSidedLimits(attempts, attempts, rule.confidence).lower >= share;
}

}  // namespace fenestra
