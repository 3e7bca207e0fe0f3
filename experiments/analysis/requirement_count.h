#pragma once

#include <array>

#include "experiments/study/envelope_rule.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

enum class RequirementVerdict {
  kHolds,      ///< Shown, with the confidence asked for.
  kFails,      ///< The opposite shown.
  kUndecided,  ///< Neither, with these trials.
};

/// "holds", "fails", "undecided".
const char* ToString(RequirementVerdict verdict);

/// Counts the good attempts of one cell under one detector for each demand of a requirement.
///
/// A demand "a share q of attempts is good" holds if the one-sided lower Clopper–Pearson limit of
/// that share is at least q, and fails if the upper one is below it. For a quantile this is the
/// bound by order statistics. The requirement holds if all demands hold: a false claim needs a
/// demand that is not met to pass its test, so the error is that of one test (R. L. Berger,
/// "Multiparameter hypothesis testing and acceptance sampling", Technometrics 24, 1982).
class RequirementCount {
 public:
  explicit RequirementCount(const EnvelopeRule& rule) : rule_(rule) {}

  void Add(const TrialRecord& row);

  RequirementVerdict verdict() const;
  /// Whether it might still hold if all of `further` more trials were good attempts.
  bool CanHoldAfter(int further) const;

  int trials() const { return trials_; }
  int attempts() const { return attempts_; }
  int hits() const { return good_[0]; }

 private:
  struct Demand {
    double share;  ///< 0: not asked.
    int good;
  };
  std::array<Demand, 3> Demands() const;

  EnvelopeRule rule_;
  int trials_ = 0;
  int attempts_ = 0;
  std::array<int, 3> good_{};  ///< Hits; within the P50's and within the P95's limit.
};

}  // namespace fenestra
