#include "experiments/check/limit_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/io/faults.h"
#include "experiments/analysis/row_selection.h"
#include "experiments/check/estimation.h"
#include "experiments/check/regression.h"
#include "experiments/output/number_format.h"

namespace fenestra {
namespace {

// A regression "holds" where errors have grown by less than a tenth and hits have fallen by less
// than five points: what a study of some hundred trials can show.
constexpr double kToleratedRatio = 1.1;
constexpr double kToleratedLoss = 0.05;
constexpr double kRegressionConfidence = 0.95;
constexpr double kMostReplicates = 1e7;

/// A limit and the rows that it is held against.
struct Task {
  Limit limit;
  std::string cell;
  std::vector<SelectedRow> rows;
};

// The least growth of the number of replicates that decides, by doubling and bisection.
std::optional<long> ReplicatesToDecide(const ConfidenceLimits& e, double confidence, double level) {
  const auto decided = [&](double growth) {
    return e.Holds(confidence, growth) || e.IsViolated(level, growth);
  };
  const double most = kMostReplicates / std::max(1, e.clusters);
  double high = 2.0;
  while (high <= most && !decided(high)) high *= 2.0;
  if (high > most) return std::nullopt;
  double low = 0.5 * high;
  for (int i = 0; i < 30 && (high - low) * e.clusters > 0.5; ++i) {
    const double middle = 0.5 * (low + high);
    (decided(middle) ? high : low) = middle;
  }
  return static_cast<long>(std::ceil(high * e.clusters));
}

LimitResult Judge(const Task& task, double level) {
  LimitResult result{.text = task.limit.text,
                     .line = task.limit.line,
                     .cell = task.cell,
                     .measured = kAbsent,
                     .confidence = task.limit.confidence};
  const auto estimation = Estimate(task.limit, task.rows);
  if (!estimation) {
    result.note = "no row counts for this metric";
    return result;
  }
  result.measured = estimation->shown;
  result.interval = estimation->interval;
  result.rows = estimation->rows;
  result.clusters = estimation->limits.clusters;
  result.note = estimation->warning;
  if (estimation->limits.Holds(task.limit.confidence)) {
    result.verdict = Verdict::kHolds;
  } else if (estimation->limits.IsViolated(level)) {
    result.verdict = Verdict::kViolated;
  } else {
    result.replicates_to_decide =
        ReplicatesToDecide(estimation->limits, task.limit.confidence, level);
  }
  return result;
}

LimitResult RegressionResult(const std::string& text, const PairedTests& tests, double p,
                             double level, const Limit& limit, std::span<const SelectedRow> rows) {
  LimitResult result{.text = text,
                     .rows = tests.pairs,
                     .clusters = tests.clusters,
                     .confidence = kRegressionConfidence};
  const auto estimation = Estimate(limit, rows);
  result.measured = estimation ? estimation->shown : kAbsent;
  if (estimation) result.interval = estimation->interval;
  result.note = tests.changed == 0 ? "the same in every trial"
                                   : fmt::format("p = {:.2g}, {} of {} trials changed", p,
                                                 tests.changed, tests.pairs);
  const bool is_unchanged = tests.pairs > 0 && tests.changed == 0;
  if (p <= level) {
    result.verdict = Verdict::kViolated;
  } else if (is_unchanged || (estimation && estimation->limits.Holds(kRegressionConfidence))) {
    result.verdict = Verdict::kHolds;
  } else if (estimation) {
    result.replicates_to_decide =
        ReplicatesToDecide(estimation->limits, kRegressionConfidence, level);
  }
  return result;
}

void AddRegressions(const std::map<std::string, std::vector<SelectedRow>>& by_detector,
                    double level, CheckResult& result) {
  for (const auto& [detector, rows] : by_detector) {
    const PairedTests tests = ComparePairs(rows);
    const Limit errors{.metric = {.kind = Metric::Kind::kRmse},
                       .is_upper = true,
                       .value = kToleratedRatio,
                       .to_baseline = true};
    const Limit hits{.metric = {.kind = Metric::Kind::kRate},
                     .is_upper = false,
                     .value = -kToleratedLoss,
                     .to_baseline = true};
    result.limits.push_back(
        RegressionResult(fmt::format("errors no larger than in the baseline: {}", detector), tests,
                         tests.p_errors_grew, level, errors, rows));
    result.limits.push_back(
        RegressionResult(fmt::format("hits no fewer than in the baseline: {}", detector), tests,
                         tests.p_hits_lost, level, hits, rows));
  }
}

std::string CellText(const TrialRecord& row) {
  return fmt::format("cell {} ({}{}{})", row.cell, row.part, row.levels.empty() ? "" : ", ",
                     LevelsText(row.levels, " = "));
}

std::vector<Task> TasksOf(const Limit& limit, const RowSelection& selection,
                          std::span<const SelectedRow> rows) {
  std::map<int, Task> cells;
  for (const SelectedRow& row : rows) {
    if (!selection.Matches(*row.row, limit.where)) continue;
    Task& task = cells[limit.in_each_cell ? row.row->cell : 0];
    task.rows.push_back(row);
    if (limit.in_each_cell) task.cell = CellText(*row.row);
  }
  std::vector<Task> tasks;
  for (auto& [cell, task] : cells) {
    task.limit = limit;
    tasks.push_back(std::move(task));
  }
  return tasks;
}

void CheckConditions(const std::string& source, std::span<const Limit> limits,
                     const RowSelection& selection) {
  Faults faults(source);
  for (const Limit& limit : limits) {
    for (const std::string& message : selection.Objections(limit.where)) {
      faults.AddFault({.line = limit.line, .message = message});
    }
  }
  faults.ThrowIfAny();
}

std::vector<SelectedRow> Pair(const std::string& source, const RowContext& context,
                              std::span<const TrialRecord> rows,
                              std::span<const TrialRecord> baseline) {
  std::map<std::tuple<int, int, std::string>, const TrialRecord*> before;
  for (const TrialRecord& row : baseline) before[{row.cell, row.trial, row.detector}] = &row;
  std::vector<SelectedRow> selected;
  for (const TrialRecord& row : rows) {
    SelectedRow pair{.row = &row, .now = context.Of(row)};
    if (!baseline.empty()) {
      const auto found = before.find({row.cell, row.trial, row.detector});
      if (found == before.end() || found->second->levels != row.levels ||
          found->second->part != row.part || found->second->drawn != row.drawn) {
        throw InputError(source,
                         fmt::format("has no trial {}/{} of {} under the same conditions: it is "
                                     "not of the same study, seed and number of trials",
                                     row.cell, row.trial, row.detector));
      }
      pair.baseline_row = found->second;
      pair.before = context.Of(*found->second);
    }
    selected.push_back(pair);
  }
  return selected;
}

}  // namespace

int CheckResult::Count(Verdict verdict) const {
  return static_cast<int>(std::count_if(limits.begin(), limits.end(),
                                        [verdict](const auto& b) { return b.verdict == verdict; }));
}

CheckResult CheckLimits(const std::string& source, const LimitFile& file, const Study& study,
                        std::span<const TrialRecord> rows, std::span<const TrialRecord> baseline) {
  const std::vector<Cell> cells = Cells(study);
  const RowSelection selection(study, cells);
  CheckConditions(source, file.limits, selection);
  const std::vector<SelectedRow> selected =
      Pair("--baseline", RowContext(study, cells), rows, baseline);
  Faults faults(source);
  std::vector<Task> tasks;
  for (const Limit& limit : file.limits) {
    const std::vector<Task> own = TasksOf(limit, selection, selected);
    const auto note = [&](const char* message) {
      faults.AddFault({.line = limit.line, .message = message});
    };
    if (own.empty()) note("this limit matches no trial of the results");
    if (limit.to_baseline && baseline.empty()) note("this limit needs --baseline");
    tasks.insert(tasks.end(), own.begin(), own.end());
  }
  faults.ThrowIfAny();

  std::map<std::string, std::vector<SelectedRow>> by_detector;
  if (!baseline.empty()) {
    for (const SelectedRow& row : selected) by_detector[row.row->detector].push_back(row);
  }
  const double tests = static_cast<double>(tasks.size() + 2 * by_detector.size());
  CheckResult result{
      .limits = {}, .false_alarm = file.false_alarm, .test_level = file.false_alarm / tests};
  for (const Task& task : tasks) result.limits.push_back(Judge(task, result.test_level));
  AddRegressions(by_detector, result.test_level, result);
  return result;
}

}  // namespace fenestra
