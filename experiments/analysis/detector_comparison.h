#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "experiments/statistics/paired.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// Two detectors on the same trials of one cell: the same pixels, so that what is left between them
/// is theirs. Trials whose target is in view, and scenes without a target.
struct DetectorComparison {
  int cell = 0;
  std::string part;
  SensorKind sensor = SensorKind::kStereo;
  FactorValues levels;
  std::string first;
  std::string second;
  /// A success is `hit`, or `clear` in a scene without a target.
  PairedCounts successes;
  Interval rate_difference_interval;  ///< See PairedDifferenceInterval; 95 %.
  double mcnemar_p = 1.0;
  /// Three-dimensional centroid errors [m] of trials with a target; +∞ without an estimate.
  ErrorComparison errors;
};

/// Collects the rows of a store in any order.
class DetectorComparisons {
 public:
  void Add(const TrialRecord& record);

  /// By cell; in each, every pair of detectors, by label. p-values and intervals are those of one
  /// comparison each.
  std::vector<DetectorComparison> Comparisons() const;

 private:
  struct Try {
    bool success = false;
    bool has_target = false;
    double error_m = 0.0;
  };
  using Tries = std::map<int, Try>;  // By trial.
  struct CellTries {
    std::string part;
    SensorKind sensor = SensorKind::kStereo;
    FactorValues levels;
    std::map<std::string, Tries> by_detector;
  };

  static DetectorComparison Compare(int cell, const CellTries& tries, const std::string& first,
                                    const std::string& second);

  std::map<int, CellTries> cells_;
};

}  // namespace fenestra
