#include "experiments/analysis/cell_tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/system/check.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

std::vector<ReasonCount> Sorted(const std::map<std::pair<Outcome, std::string>, int>& counts) {
  std::vector<ReasonCount> reasons;
  for (const auto& [key, count] : counts) reasons.push_back({key.first, key.second, count});
  std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) {
    return std::pair(a.outcome, -a.count) < std::pair(b.outcome, -b.count);
  });
  return reasons;
}

}  // namespace

void CellTally::Add(const TrialRecord& row, const RowContext& context) {
  if (counted_.trials == 0) {
    counted_.cell = row.cell;
    counted_.part = row.part;
    counted_.sensor = row.sensor;
    counted_.detector = row.detector;
    counted_.levels = row.levels;
    counted_.confidence = context.Confidence(row.cell);
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
  metrics_.Add(context.Of(row));
  AddTimes(row);
}

void CellTally::AddTimes(const TrialRecord& row) {
  if (row.score.outcome == Outcome::kCrashed || row.stages.empty()) return;
  ++counted_.timed;
  for (const StageTime& stage : row.stages) {
    auto& samples = stage_seconds_[stage.stage];
    if (samples.empty()) stages_.push_back(stage.stage);
    samples.push_back(stage.seconds);
  }
}

CellSummary CellTally::Summary() const {
  CellSummary summary = counted_;
  summary.metrics = EstimatesOf(metrics_, summary.confidence);
  summary.bounds = BoundsOfHits(metrics_.rows());
  summary.reasons = Sorted(reasons_);
  for (const std::string& stage : stages_) {
    const std::vector<double>& seconds = stage_seconds_.at(stage);
    const Interval interval = QuantileInterval(seconds, 0.5, summary.confidence);
    summary.stage_medians.push_back(
        {.stage = stage,
         .median_s = SampleQuantile(seconds, 0.5),
         .interval_s = {.lower = std::max(0.0, interval.lower), .upper = interval.upper}});
  }
  return summary;
}

void Summariser::Add(const TrialRecord& row) {
  if (row.cell != cell_) {
    FENESTRA_CHECK(row.cell > cell_, "rows must come cell by cell");
    EndCell();
    cell_ = row.cell;
  }
  tallies_[row.detector].Add(row, context_);
}

std::vector<CellSummary> Summariser::Finish() {
  EndCell();
  return std::move(summaries_);
}

void Summariser::EndCell() {
  for (const auto& [detector, tally] : tallies_) summaries_.push_back(tally.Summary());
  tallies_.clear();
}

std::vector<CellSummary> Summarise(std::span<const TrialRecord> records, RowContext context) {
  std::vector<const TrialRecord*> rows;
  rows.reserve(records.size());
  for (const TrialRecord& record : records) rows.push_back(&record);
  std::sort(rows.begin(), rows.end(), [](const TrialRecord* a, const TrialRecord* b) {
    return std::tie(a->cell, a->trial) < std::tie(b->cell, b->trial);
  });
  Summariser summariser(std::move(context));
  for (const TrialRecord* row : rows) summariser.Add(*row);
  return summariser.Finish();
}

}  // namespace fenestra
