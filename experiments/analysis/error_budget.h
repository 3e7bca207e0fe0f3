#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/statistics/moments.h"
#include "experiments/statistics/sobol_indices.h"
#include "experiments/study/study.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// Which part of one coordinate of the centroid error each cause has.
struct CoordinateBudget {
  std::string coordinate;  ///< "right", "down", "depth": x, y, z of frame C.
  double mean_m = 0.0;
  double standard_deviation_m = 0.0;
  /// With 95 % confidence: Student's, and the bootstrap's of RootMeanSquareInterval about the mean.
  std::optional<Interval> mean_interval_m;
  std::optional<Interval> standard_deviation_interval_m;
  /// One for each cause; nullopt with too few rows, or where the error does not vary.
  std::optional<std::vector<SobolIndex>> indices;
};

/// The error budget of one cell of a sensitivity design under one detector: Sobol's indices of the
/// signed error, over rows all of whose trials are hits. Rows in which the detector failed
/// somewhere are left out, which is stated: the indices are those of the error, given that there is
/// one.
struct ErrorBudget {
  int cell = 0;
  std::string part;
  SensorKind sensor = SensorKind::kStereo;
  std::string detector;
  FactorValues levels;
  std::vector<std::string> causes;
  int trials = 0;
  int hits = 0;  ///< Among the trials.
  int rows = 0;  ///< Rows of the design whose trials have all been made.
  int used_rows = 0;
  std::vector<CoordinateBudget> coordinates;
};

/// Collects the rows of a store in any order.
class ErrorBudgets {
 public:
  ErrorBudgets(const Study& study, std::span<const Cell> cells);

  /// Rows of cells with other designs are passed over.
  void Add(const TrialRecord& record);

  /// By cell, then detector. Intervals have 95 % confidence.
  std::vector<ErrorBudget> Budgets() const;

 private:
  struct Errors {
    TrialRecord first;  ///< Any row of the cell: for its names.
    int trials = 0;
    /// By trial; absent for one that is not a hit.
    std::vector<std::optional<Eigen::Vector3d>> errors;
  };

  ErrorBudget BudgetOf(const Errors& collected) const;

  uint64_t seed_;
  std::vector<std::vector<std::string>> causes_;  ///< By cell; empty with other designs.
  std::map<std::pair<int, std::string>, Errors> errors_;
};

}  // namespace fenestra
