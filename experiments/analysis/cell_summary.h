#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/analysis/metric_tally.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

class OutcomeCounts {
 public:
  void Add(Outcome outcome, int count = 1) { counts_[static_cast<size_t>(outcome)] += count; }
  int operator[](Outcome outcome) const { return counts_[static_cast<size_t>(outcome)]; }
  bool operator==(const OutcomeCounts&) const = default;

 private:
  std::array<int, kAllOutcomes.size()> counts_{};
};

/// How often trials with this outcome gave this reason (see Score::reason).
struct ReasonCount {
  Outcome outcome = Outcome::kMissed;
  std::string reason;
  int count = 0;
};

/// Median (SampleQuantile at 0.5) of a stage's time over the rows that have it.
struct StageMedian {
  std::string stage;
  double median_s = 0.0;
  Interval interval_s;  ///< QuantileInterval.
};

/// One cell under one detector, from its raw rows alone.
///
/// Denominators:  in_view = hit + gross + wrong_window + missed + crashed with a target in view;
/// without_target = false_alarm + clear + crashed in a scene without a target;
/// trials = in_view + without_target + out_of_view.
struct CellSummary {
  int cell = 0;
  std::string part;
  SensorKind sensor = SensorKind::kStereo;
  std::string detector;
  FactorValues levels;

  int trials = 0;
  int in_view = 0;
  int without_target = 0;
  OutcomeCounts counts;
  /// Every named metric that the rows have, with its interval.
  std::vector<NamedEstimate> metrics;
  double confidence = 0.95;  ///< Of each interval; see RowContext::Confidence.
  /// Over the hits; nullopt unless all of them have a bound.
  std::optional<ErrorBounds> bounds;
  /// By outcome, then the most frequent first, then by name.
  std::vector<ReasonCount> reasons;
  int timed = 0;  ///< Rows with stage times that did not crash.
  /// Over the timed rows, in the order of the detector's stages.
  std::vector<StageMedian> stage_medians;

  /// nullptr or nullopt where the rows have no such metric.
  const MetricEstimate* Find(std::string_view metric) const {
    return fenestra::Find(metrics, metric);
  }
  std::optional<double> Value(std::string_view metric) const {
    const MetricEstimate* estimate = Find(metric);
    return estimate != nullptr ? std::optional(estimate->value) : std::nullopt;
  }
};

}  // namespace fenestra
