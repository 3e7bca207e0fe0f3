#include "experiments/analysis/cell_tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/system/check.h"

namespace fenestra {
namespace {

std::optional<HitErrors> ErrorsOfHits(const std::vector<Eigen::Vector3d>& errors) {
  if (errors.empty()) return std::nullopt;
  std::array<std::vector<double>, 3> axes;
  std::vector<double> across;
  std::vector<double> all;
  for (const Eigen::Vector3d& error : errors) {
    for (int axis = 0; axis < 3; ++axis) axes[static_cast<size_t>(axis)].push_back(error[axis]);
    across.push_back(error.head<2>().norm());
    all.push_back(error.norm());
  }
  const auto& [x, y, z] = axes;
  HitErrors result;
  result.bias = {Mean(x), Mean(y), Mean(z)};
  if (all.size() >= 2) {
    result.bias_standard_error =
        Eigen::Vector3d(StandardErrorOfMean(x), StandardErrorOfMean(y), StandardErrorOfMean(z));
  }
  result.rmse = RootMeanSquare(all);
  result.rmse_depth = RootMeanSquare(z);
  result.rmse_across = RootMeanSquare(across);
  return result;
}

std::vector<ReasonCount> Sorted(const std::map<std::pair<Outcome, std::string>, int>& counts) {
  std::vector<ReasonCount> reasons;
  for (const auto& [key, count] : counts) reasons.push_back({key.first, key.second, count});
  std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) {
    return std::pair(a.outcome, -a.count) < std::pair(b.outcome, -b.count);
  });
  return reasons;
}

}  // namespace

void CellTally::Add(const TrialRecord& row) {
  if (counted_.trials == 0) {
    counted_.cell = row.cell;
    counted_.part = row.part;
    counted_.sensor = row.sensor;
    counted_.detector = row.detector;
    counted_.levels = row.levels;
  }
  FENESTRA_CHECK(row.cell == counted_.cell && row.detector == counted_.detector &&
                     row.levels == counted_.levels && row.part == counted_.part,
                 fmt::format("cell {} is not one cell", counted_.cell));
  FENESTRA_CHECK(row.trial > last_trial_, fmt::format("cell {}, trial {}, {} occurs twice or late",
                                                      row.cell, row.trial, row.detector));
  last_trial_ = row.trial;
  ++counted_.trials;
  counted_.counts.Add(row.score.outcome);
  if (row.score.IsAttempt()) ++counted_.in_view;
  if (!row.score.HasTarget()) ++counted_.without_target;
  if (!row.score.reason.empty()) ++reasons_[{row.score.outcome, row.score.reason}];
  AddErrors(row);
  AddTimes(row);
}

void CellTally::AddErrors(const TrialRecord& row) {
  if (row.score.IsAttempt()) attempt_errors_.push_back(row.score.CentroidErrorOrInfinity_m());
  if (row.score.outcome != Outcome::kHit) return;
  const auto error = row.score.CentroidError_C();
  FENESTRA_CHECK(error.has_value(), "a hit without an error");
  hit_errors_.push_back(*error);
  if (!row.bound_C) return;
  hit_bound_variances_ += row.bound_C->diagonal();
  ++bounded_hits_;
}

std::optional<ErrorBounds> CellTally::BoundsOfHits() const {
  if (bounded_hits_ < static_cast<int>(hit_errors_.size())) return std::nullopt;
  const Eigen::Vector3d variances = hit_bound_variances_ / bounded_hits_;
  return ErrorBounds{.all = std::sqrt(variances.sum()),
                     .depth = std::sqrt(variances.z()),
                     .across = std::sqrt(variances.head<2>().sum())};
}

void CellTally::AddTimes(const TrialRecord& row) {
  const auto total = row.TotalSeconds();
  if (row.score.outcome == Outcome::kCrashed || !total) return;
  total_seconds_.push_back(*total);
  for (const StageTime& stage : row.stages) {
    auto& samples = stage_seconds_[stage.stage];
    if (samples.empty()) stages_.push_back(stage.stage);
    samples.push_back(stage.seconds);
  }
}

CellSummary CellTally::Summary() const {
  CellSummary summary = counted_;
  summary.hits = MakeProportion(summary.counts[Outcome::kHit], summary.in_view);
  summary.false_alarms =
      MakeProportion(summary.counts[Outcome::kFalseAlarm], summary.without_target);
  summary.hit_errors = ErrorsOfHits(hit_errors_);
  if (summary.hit_errors) summary.hit_errors->bounds = BoundsOfHits();
  if (!attempt_errors_.empty()) {
    summary.p50_error_m = SampleQuantile(attempt_errors_, 0.50);
    summary.p95_error_m = SampleQuantile(attempt_errors_, 0.95);
  }
  summary.reasons = Sorted(reasons_);
  for (const std::string& stage : stages_) {
    summary.stage_medians.push_back({stage, SampleQuantile(stage_seconds_.at(stage), 0.5)});
  }
  summary.timed = static_cast<int>(total_seconds_.size());
  if (!total_seconds_.empty()) summary.median_total_s = SampleQuantile(total_seconds_, 0.5);
  return summary;
}

void Summariser::Add(const TrialRecord& row) {
  if (row.cell != cell_) {
    FENESTRA_CHECK(row.cell > cell_, "rows must come cell by cell");
    EndCell();
    cell_ = row.cell;
  }
  tallies_[row.detector].Add(row);
}

std::vector<CellSummary> Summariser::Finish() {
  EndCell();
  return std::move(summaries_);
}

void Summariser::EndCell() {
  for (const auto& [detector, tally] : tallies_) summaries_.push_back(tally.Summary());
  tallies_.clear();
}

std::vector<CellSummary> Summarise(std::span<const TrialRecord> records) {
  std::vector<const TrialRecord*> rows;
  rows.reserve(records.size());
  for (const TrialRecord& record : records) rows.push_back(&record);
  std::sort(rows.begin(), rows.end(), [](const TrialRecord* a, const TrialRecord* b) {
    return std::tie(a->cell, a->trial) < std::tie(b->cell, b->trial);
  });
  Summariser summariser;
  for (const TrialRecord* row : rows) summariser.Add(*row);
  return summariser.Finish();
}

}  // namespace fenestra
