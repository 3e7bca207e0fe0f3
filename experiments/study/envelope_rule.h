#pragma once

#include <string>
#include <vector>

namespace fenestra {

/// What a detector must achieve at a level to be of use there: a share (hit_rate) of at least this
/// value, or a quantile of the error (p95_error_mm) of at most this value. Over the attempts
/// (target in view); a miss is never good.
struct Demand {
  std::string metric;  ///< One of RequirementMetrics().
  double value;        ///< In its unit.

  bool operator==(const Demand&) const = default;
};

/// The share of the attempts that must be good for it: the value of a share, the level of a
/// quantile.
double ShareOf(const Demand& demand);

/// A search for the levels of one factor at which a requirement holds, for each combination of all
/// other levels.
struct EnvelopeRule {
  std::string over;             ///< A factor of the part with at least three levels, rising.
  std::vector<Demand> require;  ///< At least one; all of them must hold.
  double confidence = 0.95;

  bool operator==(const EnvelopeRule&) const = default;
};

/// Whether so many attempts, if all of them are good, show with the rule's confidence that its
/// requirement holds.
bool AllGoodSuffice(const EnvelopeRule& rule, int attempts);

}  // namespace fenestra
