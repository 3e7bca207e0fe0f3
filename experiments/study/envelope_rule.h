#pragma once

#include <optional>
#include <string>

namespace fenestra {

/// What a detector must achieve at a level to be of use there: each demand says that a share of all
/// attempts is good. Over the attempts (target in view); a miss is never good.
struct Requirement {
  double hit_rate = 0.0;               ///< At least this share are hits; 0: not asked.
  std::optional<double> p50_error_mm;  ///< At least half have at most this error.
  std::optional<double> p95_error_mm;  ///< At least 95 % have.

  bool operator==(const Requirement&) const = default;
};

/// A search for the levels of one factor at which a requirement holds, for each combination of all
/// other levels.
struct EnvelopeRule {
  std::string over;  ///< A factor of the part with at least three levels, rising.
  Requirement require;
  double confidence = 0.95;

  bool operator==(const EnvelopeRule&) const = default;
};

/// Whether so many attempts, if all of them are good, show with the rule's confidence that its
/// requirement holds.
bool AllGoodSuffice(const EnvelopeRule& rule, int attempts);

}  // namespace fenestra
