#include "experiments/analysis/paired_ratio.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

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

// Ratios of the metrics of some of a cell's pairs, each as often as it is there.
Figures RatiosOfSample(const std::vector<ErrorPair>& pairs, const std::vector<size_t>& sample) {
  std::vector<double> all;
  std::vector<double> base_all;
  std::vector<double> hits;
  std::vector<double> base_hits;
  for (const size_t i : sample) {
    const ErrorPair& pair = pairs[i];
    all.push_back(pair.error_m);
    base_all.push_back(pair.base_error_m);
    if (pair.is_hit) hits.push_back(pair.error_m);
    if (pair.base_is_hit) base_hits.push_back(pair.base_error_m);
  }
  if (sample.empty()) return {};
  return {.rmse = RatioOrNaN(RootMeanSquareOrNaN(hits), RootMeanSquareOrNaN(base_hits)),
          .p95 = RatioOrNaN(SampleQuantile(all, 0.95), SampleQuantile(base_all, 0.95))};
}

std::vector<size_t> AllOf(const std::vector<ErrorPair>& pairs) {
  std::vector<size_t> all(pairs.size());
  std::iota(all.begin(), all.end(), size_t{0});
  return all;
}

// All trials of a row of a sensitivity design are drawn together.
ClusterKey ClusterOf(const MetricRow& row) {
  ClusterKey cluster = row.cluster;
  cluster.draw = 0;
  return cluster;
}

// A pair by its cell and its place there.
using Place = std::pair<size_t, size_t>;

// What is drawn with replacement: clusters, in the order in which they first occur.
struct Pool {
  size_t first_cell = 0;
  std::vector<std::vector<Place>> clusters;
};

// One pool for all cells if any two share a cluster; else one for each cell.
std::vector<Pool> PoolsOf(std::span<const std::vector<ErrorPair>> cells) {
  std::vector<Pool> pools;
  Pool together;
  std::map<ClusterKey, std::pair<size_t, size_t>> known;  // Its place in `together`, its cell.
  bool shared = false;
  for (size_t c = 0; c < cells.size(); ++c) {
    Pool own{.first_cell = c, .clusters = {}};
    std::map<ClusterKey, size_t> of_cell;
    for (size_t i = 0; i < cells[c].size(); ++i) {
      const auto& key = cells[c][i].cluster;
      const auto add = [&](Pool& pool, std::optional<size_t> at) {
        if (!at) pool.clusters.emplace_back();
        pool.clusters[at.value_or(pool.clusters.size() - 1)].push_back({c, i});
      };
      const auto in_own = key ? of_cell.find(*key) : of_cell.end();
      add(own, in_own == of_cell.end() ? std::nullopt : std::optional(in_own->second));
      if (key) of_cell.try_emplace(*key, own.clusters.size() - 1);
      const auto in_all = key ? known.find(*key) : known.end();
      shared = shared || (in_all != known.end() && in_all->second.second != c);
      add(together, in_all == known.end() ? std::nullopt : std::optional(in_all->second.first));
      if (key) known.try_emplace(*key, together.clusters.size() - 1, c);
    }
    pools.push_back(std::move(own));
  }
  return shared ? std::vector<Pool>{std::move(together)} : pools;
}

// The pairs of each cell in one bootstrap sample.
std::vector<std::vector<size_t>> Resample(const std::vector<Pool>& pools, size_t cells,
                                          const RandomStream& stream, uint64_t k) {
  std::vector<std::vector<size_t>> samples(cells);
  for (const Pool& pool : pools) {
    const RandomStream draws = stream.Child("cell", pool.first_cell).Child("resample", k);
    const auto n = static_cast<double>(pool.clusters.size());
    for (size_t i = 0; i < pool.clusters.size(); ++i) {
      for (const auto& [cell, pair] : pool.clusters[static_cast<size_t>(n * draws.Uniform(i))]) {
        samples[cell].push_back(pair);
      }
    }
  }
  return samples;
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
    result.pairs += static_cast<int>(cell.size());
    const Figures figures = RatiosOfSample(cell, AllOf(cell));
    rmse.push_back(figures.rmse);
    p95.push_back(figures.p95);
  }
  const std::vector<Pool> pools = PoolsOf(cells);
  std::vector<double> resampled_rmse;
  std::vector<double> resampled_p95;
  for (uint64_t k = 0; k < kResamples; ++k) {
    const auto samples = Resample(pools, cells.size(), stream, k);
    std::vector<double> rmse_k;
    std::vector<double> p95_k;
    for (size_t c = 0; c < cells.size(); ++c) {
      const Figures figures = RatiosOfSample(cells[c], samples[c]);
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

std::vector<PairedCells> PairsBy(std::span<const TrialRecord> records, const std::string& factor,
                                 const RowContext& context) {
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
                               .base_is_hit = other->second->score.outcome == Outcome::kHit,
                               .cluster = ClusterOf(context.Of(*row))});
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
