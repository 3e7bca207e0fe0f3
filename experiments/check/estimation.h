#pragma once

#include <optional>
#include <span>
#include <string>

#include "experiments/analysis/confidence_limits.h"
#include "experiments/check/limit.h"

namespace fenestra {

/// A row that a limit speaks of, and the same trial in the baseline.
struct SelectedRow {
  const TrialRecord* row;
  MetricRow now;
  const TrialRecord* baseline_row = nullptr;
  std::optional<MetricRow> before{};
};

/// What rows tell of the number that a limit limits.
struct Estimation {
  ConfidenceLimits limits;
  int rows = 0;            ///< That count.
  std::string shown{};     ///< The estimate for people, with its unit.
  std::string interval{};  ///< With 95 %; empty where there is none.
  std::string warning{};   ///< Why "holds" may not be true; empty as a rule.
};

/// By MetricTally and LimitsOf. Against a baseline: ratios of rmse by Student's t on the logarithm
/// of the ratio of mean squares, to first order, on pairs that both hit; differences of rates by
/// the limits of what became better and what became worse, each with half of the error. All allow
/// for clusters.
///
/// nullopt with no row that counts (no attempt, no hit).
std::optional<Estimation> Estimate(const Limit& limit, std::span<const SelectedRow> rows);

}  // namespace fenestra
