#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/statistics/moments.h"
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

/// A share with its denominator, and the 95 % Clopper–Pearson interval of its probability.
struct Proportion {
  int count = 0;
  int of = 0;
  Interval interval95;

  /// Domain: of ≥ 1.
  double rate() const { return static_cast<double>(count) / of; }
};

Proportion MakeProportion(int count, int of);

/// What the errors of unbiased estimates would be at least, by Cramér and Rao: √ of the mean over
/// trials of the bound's trace, and of its parts. Metres.
struct ErrorBounds {
  double all = 0.0;
  double depth = 0.0;
  double across = 0.0;
};

/// Centroid errors over the hits of a cell. Frame C; metres.
struct HitErrors {
  Eigen::Vector3d bias;                                ///< Mean of estimate minus truth.
  std::optional<Eigen::Vector3d> bias_standard_error;  ///< From two hits on.
  double rmse = 0.0;                                   ///< √(mean of x² + y² + z²)
  double rmse_depth = 0.0;                             ///< √(mean of z²)
  double rmse_across = 0.0;                            ///< √(mean of x² + y²)
  /// Over the same hits; nullopt unless all of them have a bound.
  std::optional<ErrorBounds> bounds;

  /// rmse and rmse_depth as multiples of their bounds.
  std::optional<double> OverBound() const;
  std::optional<double> DepthOverBound() const;
};

/// How often trials with this outcome gave this reason (see Score::reason).
struct ReasonCount {
  Outcome outcome = Outcome::kMissed;
  std::string reason;
  int count = 0;
};

struct StageMedian {
  std::string stage;
  double median_s = 0.0;
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
  Proportion hits;                      ///< Of in_view.
  Proportion false_alarms;              ///< Of without_target.
  std::optional<HitErrors> hit_errors;  ///< From one hit on.
  /// Quantiles of the three-dimensional centroid error over all in_view attempts; an attempt
  /// without an estimate (missed, crashed) counts as +∞, so that declining the hard ones pays
  /// nothing. nullopt for in_view = 0. See SampleQuantile.
  std::optional<double> p50_error_m;
  std::optional<double> p95_error_m;
  /// By outcome, then the most frequent first, then by name.
  std::vector<ReasonCount> reasons;
  int timed = 0;  ///< Rows with stage times that did not crash.
  /// Medians (SampleQuantile at 0.5) over those of the timed rows that have the stage, in the
  /// order of the detector's stages.
  std::vector<StageMedian> stage_medians;
  std::optional<double> median_total_s;
};

}  // namespace fenestra
