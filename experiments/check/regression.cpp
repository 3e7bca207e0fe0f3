#include "experiments/check/regression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "experiments/statistics/paired.h"

namespace fenestra {
namespace {

constexpr double kMissDistance_m = std::numeric_limits<double>::infinity();

double ErrorOf(const MetricRow& row) {
  return row.error_C ? row.error_C->norm() : kMissDistance_m;
}

struct Difference {
  ClusterKey cluster;
  double error = 0.0;  ///< Now less before, ±∞ included; 0 with both infinite.
};

// Average ranks of |difference| over n, with the differences' signs; 0 for no difference.
void AddSignedRanks(std::vector<Difference> cell,
                    std::map<ClusterKey, std::pair<double, int>>& sums) {
  std::sort(cell.begin(), cell.end(), [](const Difference& a, const Difference& b) {
    return std::abs(a.error) < std::abs(b.error);
  });
  const double n = static_cast<double>(cell.size());
  for (size_t begin = 0; begin < cell.size();) {
    size_t end = begin;
    while (end < cell.size() && std::abs(cell[end].error) == std::abs(cell[begin].error)) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);
    for (size_t i = begin; i < end; ++i) {
      auto& [sum, count] = sums[cell[i].cluster];
      const double sign = cell[i].error > 0.0 ? 1.0 : cell[i].error < 0.0 ? -1.0 : 0.0;
      sum += sign * rank / n;
      ++count;
    }
    begin = end;
  }
}

bool IsPairOfAttempts(const SelectedRow& row) {
  return row.now.is_independent && row.now.IsAttempt() && row.before->IsAttempt();
}

}  // namespace

PairedTests ComparePairs(std::span<const SelectedRow> rows) {
  PairedTests tests;
  std::map<int, std::vector<Difference>> cells;
  std::map<ClusterKey, double> lost;
  for (const SelectedRow& row : rows) {
    if (!IsPairOfAttempts(row)) continue;
    ++tests.pairs;
    const double now = ErrorOf(row.now);
    const double before = ErrorOf(*row.before);
    const bool both_infinite = std::isinf(now) && std::isinf(before);
    cells[row.row->cell].push_back({row.now.cluster, both_infinite ? 0.0 : now - before});
    tests.changed += now != before ? 1 : 0;
    const int hit = row.now.outcome == Outcome::kHit ? 1 : 0;
    const int hit_before = row.before->outcome == Outcome::kHit ? 1 : 0;
    lost[row.now.cluster] += hit_before - hit;
  }
  tests.clusters = static_cast<int>(lost.size());
  std::map<ClusterKey, std::pair<double, int>> ranks;
  for (auto& [cell, differences] : cells) AddSignedRanks(std::move(differences), ranks);
  std::vector<double> of_errors;
  for (const auto& [cluster, sum] : ranks) of_errors.push_back(sum.first / sum.second);
  std::vector<double> of_hits;
  for (const auto& [cluster, net] : lost) of_hits.push_back(net);
  tests.p_errors_grew = SignFlipPValue(of_errors);
  tests.p_hits_lost = SignFlipPValue(of_hits);
  return tests;
}

}  // namespace fenestra
