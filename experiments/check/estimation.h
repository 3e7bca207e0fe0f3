#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>

#include "experiments/check/bound.h"

namespace fenestra {

/// A row that a bound speaks of, and the cluster that it belongs to (see RowSelection::Cluster).
struct SelectedRow {
  const TrialRecord* row;
  std::pair<int, int> cluster;
  const TrialRecord* baseline = nullptr;  ///< The same trial in the baseline.
};

/// What rows tell of the number that a bound limits.
struct Estimation {
  double estimate = 0.0;
  int rows = 0;
  int clusters = 0;
  std::string shown{};  ///< The estimate for people, with its unit.
  /// One-sided limits at a confidence, from `growth` times the rows with the same scatter.
  std::function<double(double confidence, double growth)> lower{};
  std::function<double(double confidence, double growth)> upper{};
  /// The limited number may be a share where the bound names a quantile: p95 ≤ 15 says that the
  /// share of what is within 15 is at least 0.95. The limit and its sense, translated:
  double limit = 0.0;
  bool is_upper = true;
};

/// Rates and quantiles by Clopper–Pearson limits of shares, exact where each cluster is one row;
/// biases by Student's t; an rmse by Student's t on the logarithm of the mean square, to first
/// order; ratios of rmse likewise, on pairs that both hit; differences of rates by the limits of
/// what became better and what became worse, each with half of the error. All allow for clusters.
///
/// nullopt with no row that counts (no attempt, no hit); see Figure.
std::optional<Estimation> Estimate(const Bound& bound, std::span<const SelectedRow> rows);

}  // namespace fenestra
