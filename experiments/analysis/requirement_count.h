#pragma once

#include <optional>

#include "experiments/analysis/confidence_limits.h"
#include "experiments/study/envelope_rule.h"

namespace fenestra {

/// Counts the good attempts of one cell under one detector for each demand of a requirement.
///
/// A demand "a share q of attempts is good" holds if the one-sided lower Clopper–Pearson limit of
/// that share is at least q, and is violated if the upper one is below it
/// (ConfidenceLimits). For a quantile this is the
/// bound by order statistics. The requirement holds if all demands hold: a false claim needs a
/// demand that is not met to pass its test, so the error is that of one test (R. L. Berger,
/// "Multiparameter hypothesis testing and acceptance sampling", Technometrics 24, 1982).
class RequirementCount {
 public:
  explicit RequirementCount(EnvelopeRule rule) : rule_(std::move(rule)) {}

  void Add(const MetricRow& row);

  Verdict verdict() const;
  /// Whether it might still hold if all of `further` more trials were good attempts.
  bool CanHoldAfter(int further) const;

  int trials() const { return static_cast<int>(tally_.rows().size()); }
  int attempts() const { return attempts_; }

 private:
  std::optional<ConfidenceLimits> LimitsOf(const Demand& demand) const;

  EnvelopeRule rule_;
  MetricTally tally_;
  int attempts_ = 0;
};

}  // namespace fenestra
