#include "experiments/analysis/paired_ratio.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/io/input_error.h"
#include "core/system/check.h"

namespace fenestra {
namespace {

constexpr int kResamples = 2000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Figures {
  double rmse = kNaN;
  double p95 = kNaN;
};

double RatioOrNaN(double a, double b) {
  const double ratio = a / b;
  return std::isfinite(ratio) && ratio > 0.0 ? ratio : kNaN;
}

double RootMeanSquareOrNaN(const std::vector<double>& errors) {
  return errors.empty() ? kNaN : RootMeanSquare(errors);
}

// Ratios of a sample's figures; `draw(i)`: which pair is the sample's i-th.
template <typename Draw>
Figures RatiosOfSample(const std::vector<ErrorPair>& pairs, const Draw& draw) {
  std::vector<double> all;
  std::vector<double> base_all;
  std::vector<double> hits;
  std::vector<double> base_hits;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const ErrorPair& pair = pairs[draw(i)];
    all.push_back(pair.error_m);
    base_all.push_back(pair.base_error_m);
    if (pair.is_hit) hits.push_back(pair.error_m);
    if (pair.base_is_hit) base_hits.push_back(pair.base_error_m);
  }
  return {.rmse = RatioOrNaN(RootMeanSquareOrNaN(hits), RootMeanSquareOrNaN(base_hits)),
          .p95 = RatioOrNaN(SampleQuantile(all, 0.95), SampleQuantile(base_all, 0.95))};
}

double GeometricMean(const std::vector<double>& ratios) {
  double sum = 0.0;
  int count = 0;
  for (const double ratio : ratios) {
    if (std::isnan(ratio)) continue;
    sum += std::log(ratio);
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : kNaN;
}

Ratio WithInterval(double value, std::vector<double> resampled) {
  std::erase_if(resampled, [](double x) { return std::isnan(x); });
  if (std::isnan(value) || resampled.empty()) return {kNaN, {kNaN, kNaN}};
  return {value, {SampleQuantile(resampled, 0.05), SampleQuantile(resampled, 0.95)}};
}

}  // namespace

PairedRatios RatiosOf(std::span<const std::vector<ErrorPair>> cells, const RandomStream& stream) {
  FENESTRA_CHECK(!cells.empty(), "no cells");
  PairedRatios result;
  std::vector<double> rmse;
  std::vector<double> p95;
  for (const std::vector<ErrorPair>& cell : cells) {
    FENESTRA_CHECK(!cell.empty(), "a cell without pairs");
    result.pairs += static_cast<int>(cell.size());
    const Figures figures = RatiosOfSample(cell, [](size_t i) { return i; });
    rmse.push_back(figures.rmse);
    p95.push_back(figures.p95);
  }
  std::vector<double> resampled_rmse;
  std::vector<double> resampled_p95;
  for (uint64_t k = 0; k < kResamples; ++k) {
    std::vector<double> rmse_k;
    std::vector<double> p95_k;
    for (size_t c = 0; c < cells.size(); ++c) {
      const RandomStream draws = stream.Child("cell", c).Child("resample", k);
      const auto n = static_cast<double>(cells[c].size());
      const Figures figures = RatiosOfSample(
          cells[c], [&](size_t i) { return static_cast<size_t>(n * draws.Uniform(i)); });
      // A cell counts as it does in the whole sample.
      rmse_k.push_back(std::isnan(rmse[c]) ? kNaN : figures.rmse);
      p95_k.push_back(std::isnan(p95[c]) ? kNaN : figures.p95);
    }
    resampled_rmse.push_back(GeometricMean(rmse_k));
    resampled_p95.push_back(GeometricMean(p95_k));
  }
  result.rmse = WithInterval(GeometricMean(rmse), std::move(resampled_rmse));
  result.p95_error = WithInterval(GeometricMean(p95), std::move(resampled_p95));
  return result;
}

std::vector<PairedCells> PairsBy(std::span<const TrialRecord> records, const std::string& factor) {
  struct LevelRows {
    std::string level;
    std::map<int, const TrialRecord*> rows;  // By trial.
  };
  // By what the cells have in common; in the order of their indices.
  std::map<std::string, std::vector<std::pair<int, LevelRows>>> groups;
  std::vector<std::string> order;
  bool is_known = false;
  for (const TrialRecord& row : records) {
    FactorValues rest = row.levels;
    const auto at = std::find_if(rest.begin(), rest.end(),
                                 [&](const auto& level) { return level.first == factor; });
    if (at == rest.end()) continue;
    is_known = true;
    const std::string level = ToString(at->second);
    rest.erase(at);
    const std::string key =
        fmt::format("{}/{}/{}/{}", row.part, ToString(row.sensor), row.detector, LevelsText(rest));
    auto& group = groups[key];
    if (group.empty()) order.push_back(key);
    auto cell = std::find_if(group.begin(), group.end(),
                             [&](const auto& entry) { return entry.first == row.cell; });
    if (cell == group.end())
      cell = group.insert(cell, std::pair<int, LevelRows>(row.cell, LevelRows{level, {}}));
    cell->second.rows[row.trial] = &row;
  }
  if (!is_known) {
    throw InputError("--factor", fmt::format("'{}' has no levels in this study", factor));
  }
  std::vector<PairedCells> paired;
  for (const std::string& key : order) {
    const auto& group = groups[key];
    const LevelRows& base = group.front().second;
    for (size_t i = 1; i < group.size(); ++i) {
      const LevelRows& cell = group[i].second;
      const TrialRecord& first = *cell.rows.begin()->second;
      PairedCells pairs{.part = first.part,
                        .sensor = first.sensor,
                        .detector = first.detector,
                        .levels = first.levels,
                        .level = cell.level,
                        .base_level = base.level,
                        .pairs = {}};
      std::erase_if(pairs.levels, [&](const auto& level) { return level.first == factor; });
      for (const auto& [trial, row] : cell.rows) {
        const auto other = base.rows.find(trial);
        if (other == base.rows.end() || !row->score.IsAttempt() ||
            !other->second->score.IsAttempt())
          continue;
        pairs.pairs.push_back({.error_m = row->score.CentroidErrorOrInfinity_m(),
                               .base_error_m = other->second->score.CentroidErrorOrInfinity_m(),
                               .is_hit = row->score.outcome == Outcome::kHit,
                               .base_is_hit = other->second->score.outcome == Outcome::kHit});
      }
      if (!pairs.pairs.empty()) paired.push_back(std::move(pairs));
    }
  }
  if (paired.empty()) {
    throw InputError("--factor",
                     fmt::format("no two cells of this study differ in '{}' alone", factor));
  }
  return paired;
}

}  // namespace fenestra
