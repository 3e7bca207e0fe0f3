#include "experiments/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "core/check.h"

namespace fenestra {
namespace {

using Rows = std::span<const TrialRecord* const>;  // One cell under one detector, by trial.

std::vector<const TrialRecord*> SortedByKey(std::span<const TrialRecord> records) {
  std::vector<const TrialRecord*> rows;
  rows.reserve(records.size());
  for (const TrialRecord& record : records) rows.push_back(&record);
  const auto key = [](const TrialRecord* r) { return std::tie(r->cell, r->detector, r->trial); };
  std::sort(rows.begin(), rows.end(), [&](auto* a, auto* b) { return key(a) < key(b); });
  for (size_t i = 1; i < rows.size(); ++i) {
    FENESTRA_CHECK(key(rows[i - 1]) < key(rows[i]),
                   fmt::format("cell {}, trial {}, {} occurs twice", rows[i]->cell, rows[i]->trial,
                               rows[i]->detector));
  }
  return rows;
}

std::optional<ErrorBounds> BoundsOfHits(Rows rows) {
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();
  int hits = 0;
  for (const TrialRecord* row : rows) {
    if (row->score.outcome != Outcome::kHit) continue;
    if (!row->bound_C) return std::nullopt;
    variances += row->bound_C->diagonal();
    ++hits;
  }
  variances /= hits;
  return ErrorBounds{.all = std::sqrt(variances.sum()),
                     .depth = std::sqrt(variances.z()),
                     .across = std::sqrt(variances.head<2>().sum())};
}

std::optional<HitErrors> ErrorsOfHits(Rows rows) {
  std::array<std::vector<double>, 3> errors;
  std::vector<double> across;
  std::vector<double> all;
  for (const TrialRecord* row : rows) {
    if (row->score.outcome != Outcome::kHit) continue;
    const auto error = row->score.CentroidError_C();
    FENESTRA_CHECK(error.has_value(), "a hit without an error");
    for (int axis = 0; axis < 3; ++axis)
      errors[static_cast<size_t>(axis)].push_back((*error)[axis]);
    across.push_back(error->head<2>().norm());
    all.push_back(error->norm());
  }
  if (all.empty()) return std::nullopt;
  const auto& [x, y, z] = errors;
  HitErrors result;
  result.bias = {Mean(x), Mean(y), Mean(z)};
  if (all.size() >= 2) {
    result.bias_standard_error =
        Eigen::Vector3d(StandardErrorOfMean(x), StandardErrorOfMean(y), StandardErrorOfMean(z));
  }
  result.rmse = RootMeanSquare(all);
  result.rmse_depth = RootMeanSquare(z);
  result.rmse_across = RootMeanSquare(across);
  result.bounds = BoundsOfHits(rows);
  return result;
}

bool HasTarget(const TrialRecord& row) {
  return row.score.truth_p_CO.has_value();
}

bool IsAttempt(const TrialRecord& row) {
  return HasTarget(row) && row.score.outcome != Outcome::kOutOfView;
}

/// Errors of all in-view attempts; +∞ where there is no estimate.
std::vector<double> AttemptErrors(Rows rows) {
  std::vector<double> errors;
  for (const TrialRecord* row : rows) {
    if (!IsAttempt(*row)) continue;
    const auto error = row->score.CentroidError_C();
    errors.push_back(error ? error->norm() : std::numeric_limits<double>::infinity());
  }
  return errors;
}

std::vector<ReasonCount> CountReasons(Rows rows) {
  std::map<std::pair<Outcome, std::string>, int> counts;
  for (const TrialRecord* row : rows) {
    if (!row->score.reason.empty()) ++counts[{row->score.outcome, row->score.reason}];
  }
  std::vector<ReasonCount> reasons;
  for (const auto& [key, count] : counts) reasons.push_back({key.first, key.second, count});
  std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) {
    return std::pair(a.outcome, -a.count) < std::pair(b.outcome, -b.count);
  });
  return reasons;
}

void SummariseTimes(Rows rows, CellSummary& summary) {
  std::vector<std::string> stages;
  std::map<std::string, std::vector<double>> seconds;
  std::vector<double> totals;
  for (const TrialRecord* row : rows) {
    const auto total = row->TotalSeconds();
    if (row->score.outcome == Outcome::kCrashed || !total) continue;
    totals.push_back(*total);
    for (const StageTime& stage : row->stages) {
      auto& samples = seconds[stage.stage];
      if (samples.empty()) stages.push_back(stage.stage);
      samples.push_back(stage.seconds);
    }
  }
  for (const std::string& stage : stages) {
    summary.stage_medians.push_back({stage, SampleQuantile(seconds[stage], 0.5)});
  }
  summary.timed = static_cast<int>(totals.size());
  if (!totals.empty()) summary.median_total_s = SampleQuantile(totals, 0.5);
}

CellSummary SummariseCell(Rows rows) {
  const TrialRecord& first = *rows.front();
  CellSummary summary;
  summary.cell = first.cell;
  summary.part = first.part;
  summary.sensor = first.sensor;
  summary.detector = first.detector;
  summary.levels = first.levels;
  for (const TrialRecord* row : rows) {
    FENESTRA_CHECK(row->levels == first.levels && row->part == first.part,
                   fmt::format("cell {} is not one cell", first.cell));
    ++summary.trials;
    summary.counts.Add(row->score.outcome);
    if (IsAttempt(*row)) ++summary.in_view;
    if (!HasTarget(*row)) ++summary.without_target;
  }
  summary.hits = MakeProportion(summary.counts[Outcome::kHit], summary.in_view);
  summary.false_alarms =
      MakeProportion(summary.counts[Outcome::kFalseAlarm], summary.without_target);
  summary.hit_errors = ErrorsOfHits(rows);
  if (const std::vector<double> errors = AttemptErrors(rows); !errors.empty()) {
    summary.p50_error_m = SampleQuantile(errors, 0.50);
    summary.p95_error_m = SampleQuantile(errors, 0.95);
  }
  summary.reasons = CountReasons(rows);
  SummariseTimes(rows, summary);
  return summary;
}

}  // namespace

std::optional<double> HitErrors::OverBound() const {
  return bounds ? std::optional(rmse / bounds->all) : std::nullopt;
}

std::optional<double> HitErrors::DepthOverBound() const {
  return bounds ? std::optional(rmse_depth / bounds->depth) : std::nullopt;
}

Proportion MakeProportion(int count, int of) {
  return {.count = count, .of = of, .interval95 = ClopperPearson(count, of, 0.95)};
}

std::vector<CellSummary> Summarise(std::span<const TrialRecord> records) {
  const std::vector<const TrialRecord*> rows = SortedByKey(records);
  std::vector<CellSummary> summaries;
  for (size_t begin = 0; begin < rows.size();) {
    size_t end = begin + 1;
    while (end < rows.size() && rows[end]->cell == rows[begin]->cell &&
           rows[end]->detector == rows[begin]->detector) {
      ++end;
    }
    summaries.push_back(SummariseCell(Rows(rows).subspan(begin, end - begin)));
    begin = end;
  }
  return summaries;
}

}  // namespace fenestra
