#include "experiments/analysis/figure_tally.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/system/check.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

constexpr double kMillimetres = 1e3;

std::optional<Interval> InMillimetres(const std::optional<Interval>& metres) {
  if (!metres) return std::nullopt;
  return Interval{.lower = kMillimetres * metres->lower, .upper = kMillimetres * metres->upper};
}

// An error is a length: that nothing bounds its quantile from below says that 0 does.
Interval NotNegative(const Interval& interval) {
  return {.lower = std::max(0.0, interval.lower), .upper = interval.upper};
}

}  // namespace

void FigureTally::Add(const TrialRecord& row) {
  const Outcome outcome = row.score.outcome;
  if (!row.score.HasTarget()) {
    ++without_target_;
    if (outcome != Outcome::kCrashed) ++counts_[static_cast<size_t>(outcome)];
    return;
  }
  ++with_target_;
  ++counts_[static_cast<size_t>(outcome)];
  if (outcome == Outcome::kOutOfView) return;
  ++in_view_;
  attempt_errors_.push_back(row.score.CentroidErrorOrInfinity_m());
  if (outcome != Outcome::kHit) return;
  const auto error = row.score.CentroidError_C();
  FENESTRA_CHECK(error.has_value(), "a hit without an error");
  hit_errors_.push_back(*error);
}

std::vector<FigureEstimate> FigureTally::Figures(double confidence) const {
  std::vector<FigureEstimate> figures;
  AddRates(confidence, figures);
  AddErrors(confidence, figures);
  return figures;
}

void FigureTally::AddRates(double confidence, std::vector<FigureEstimate>& figures) const {
  const auto add = [&](Outcome outcome, int of) {
    if (of == 0) return;
    const int count = counts_[static_cast<size_t>(outcome)];
    figures.push_back({.figure = fmt::format("{}_rate", ToString(outcome)),
                       .value = static_cast<double>(count) / of,
                       .of = of,
                       .interval = ClopperPearson(count, of, confidence),
                       .method = "Clopper-Pearson"});
  };
  for (const Outcome outcome : {Outcome::kHit, Outcome::kGross, Outcome::kWrongWindow,
                                Outcome::kMissed, Outcome::kCrashed}) {
    add(outcome, in_view_);
  }
  add(Outcome::kOutOfView, with_target_);
  add(Outcome::kFalseAlarm, without_target_);
  add(Outcome::kClear, without_target_);
}

void FigureTally::AddErrors(double confidence, std::vector<FigureEstimate>& figures) const {
  const auto hits = static_cast<int>(hit_errors_.size());
  const auto add = [&](const std::string& figure, double metres, int of,
                       const std::optional<Interval>& interval, const char* method) {
    figures.push_back({.figure = figure,
                       .value = kMillimetres * metres,
                       .of = of,
                       .interval = InMillimetres(interval),
                       .method = method});
  };
  std::array<std::vector<double>, 3> axes;
  std::vector<double> lengths;
  std::vector<double> across;
  for (const Eigen::Vector3d& error : hit_errors_) {
    for (int axis = 0; axis < 3; ++axis) axes[static_cast<size_t>(axis)].push_back(error[axis]);
    lengths.push_back(error.norm());
    across.push_back(error.head<2>().norm());
  }
  if (hits > 0) {
    for (size_t axis = 0; axis < 3; ++axis) {
      add(fmt::format("bias_{}_mm", "xyz"[axis]), Mean(axes[axis]), hits,
          MeanInterval(axes[axis], confidence), "Student");
    }
    // The same resampling for every cell: equal rows give equal figures.
    const RandomStream resampling = RandomStream(0).Child("rms_interval");
    const auto add_rms = [&](const char* figure, const std::vector<double>& values) {
      add(figure, RootMeanSquare(values), hits,
          RootMeanSquareInterval(values, resampling, confidence), "bootstrap");
    };
    add_rms("rmse_mm", lengths);
    add_rms("rmse_depth_mm", axes[2]);
    add_rms("rmse_across_mm", across);
  }
  if (in_view_ == 0) return;
  for (const auto& [figure, p] :
       {std::pair("p50_error_mm", 0.50), std::pair("p95_error_mm", 0.95)}) {
    add(figure, SampleQuantile(attempt_errors_, p), in_view_,
        NotNegative(QuantileInterval(attempt_errors_, p, confidence)), "order statistics");
  }
}

}  // namespace fenestra
