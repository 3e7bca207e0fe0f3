#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/statistics/moments.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// A figure of one cell under one detector with its interval.
struct FigureEstimate {
  std::string figure;  ///< "hit_rate", "bias_z_mm", "p95_error_mm", ...
  double value = 0.0;
  int of = 0;  ///< The trials it was made of.
  /// nullopt where there are too few of them.
  std::optional<Interval> interval;
  std::string method;  ///< "Clopper-Pearson", "Student", "bootstrap", "order statistics"
};

/// Collects the rows of one cell under one detector for figures with intervals.
class FigureTally {
 public:
  void Add(const TrialRecord& row);

  /// All figures that exist, each interval with this confidence for itself:
  ///
  ///   hit_rate, gross_rate, wrong_window_rate, missed_rate, crashed_rate   of attempts (in view)
  ///   out_of_view_rate                                     of trials with a target
  ///   false_alarm_rate, clear_rate                         of scenes without one
  ///   bias_x_mm, bias_y_mm, bias_z_mm                      over hits; MeanInterval
  ///   rmse_mm, rmse_depth_mm, rmse_across_mm               over hits; RootMeanSquareInterval
  ///   p50_error_mm, p95_error_mm          over attempts, misses as +∞; QuantileInterval
  std::vector<FigureEstimate> Figures(double confidence) const;

 private:
  void AddRates(double confidence, std::vector<FigureEstimate>& figures) const;
  void AddErrors(double confidence, std::vector<FigureEstimate>& figures) const;

  int in_view_ = 0;
  int with_target_ = 0;
  int without_target_ = 0;
  std::array<int, kAllOutcomes.size()> counts_{};
  std::vector<Eigen::Vector3d> hit_errors_;
  std::vector<double> attempt_errors_;
};

}  // namespace fenestra
