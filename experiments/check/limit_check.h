#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/confidence_limits.h"
#include "experiments/check/limit_file.h"
#include "experiments/study/study.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// One limit held against the rows, or the same in one cell.
struct LimitResult {
  std::string text{};  ///< The limit as written.
  int line = 0;        ///< In its file; 0 if it stands in none.
  std::string cell{};  ///< "distance_m = 3" of a limit in each cell; else empty.
  Verdict verdict = Verdict::kUndecided;
  std::string measured{};   ///< The metric with its unit; "—" where there is none.
  std::string interval{};   ///< Two-sided, with 95 %; empty where there is none.
  int rows = 0;             ///< That count for the metric.
  int clusters = 0;         ///< Independent witnesses among them: see ClusterKey.
  double confidence = 0.0;  ///< Of "holds".
  /// Replicates that would decide if the rows went on as they are; nullopt if decided, or if no
  /// number below 10^7 would.
  std::optional<long> replicates_to_decide{};
  std::string note{};
};

struct CheckResult {
  std::vector<LimitResult> limits;
  double false_alarm = 0.05;
  /// Level of each test for a violation: false_alarm over the number of results (Bonferroni), so
  /// that P(any "violated" | all hold) ≤ false_alarm.
  double test_level = 0.05;

  int Count(Verdict verdict) const;
};

/// How rows are held against limits:
///
///   holds       the limited number's one-sided confidence limit, at the limit's confidence, is
///               within the limit
///   violated    its opposite confidence limit, at confidence 1 - test_level, is beyond
///   undecided   neither
///
/// With a baseline, rows are compared trial by trial, and two tests more are made for each
/// detector: whether errors have grown (see RegressionChecks). Throws InputError where a limit
/// matches no row, or where the baseline has no such trial.
CheckResult CheckLimits(const std::string& source, const LimitFile& file, const Study& study,
                        std::span<const TrialRecord> rows, std::span<const TrialRecord> baseline);

}  // namespace fenestra
