#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/random/random_stream.h"
#include "experiments/analysis/row_context.h"
#include "experiments/statistics/moments.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// One trial under two conditions: centroid errors [m], +∞ without an estimate.
struct ErrorPair {
  double error_m = 0.0;
  double base_error_m = 0.0;
  bool is_hit = false;  ///< Which errors count as hits.
  bool base_is_hit = false;
  /// Pairs with equal ones share random numbers; without one, a pair shares them with no other.
  std::optional<ClusterKey> cluster{};
};

/// A ratio with its interval; NaN where a figure does not exist or is infinite in both samples.
struct Ratio {
  double value = 0.0;
  Interval interval90;
};

/// How one condition compares with another in trials that are pairs: the same poses, the same
/// scenes, and as far as both draw them the same random numbers.
struct PairedRatios {
  int pairs = 0;    ///< In view.
  Ratio rmse;       ///< Of the hits, each condition's own.
  Ratio p95_error;  ///< Of all attempts; see SampleQuantile.
};

/// Ratios of a condition's metrics (rmse_mm, p95_error_mm) to those of the base, with 90 %
/// intervals: percentiles of 2000 bootstrap samples, each of which draws whole pairs with
/// replacement (B. Efron and R. Tibshirani, "An Introduction to the Bootstrap", 1993, chapters 8
/// and 13). Of several cells: the geometric mean of the cells' ratios. Cells that share clusters
/// draw the same ones, with all pairs of each; other cells are drawn anew each by itself. Cells
/// whose ratio is NaN, 0 or infinite are left out. Domain: at least one cell, each with at least
/// one pair.
PairedRatios RatiosOf(std::span<const std::vector<ErrorPair>> cells, const RandomStream& stream);

/// The cells of two levels of a factor that are alike in all else, for one detector.
struct PairedCells {
  std::string part;
  SensorKind sensor = SensorKind::kRgbd;
  std::string detector;
  FactorValues levels;  ///< Without the factor.
  std::string level;
  std::string base_level;
  std::vector<ErrorPair> pairs;
};

/// All pairs of cells that differ in this factor alone, each against that with the first level that
/// occurs; trials in view under both levels. Throws InputError if the factor is not varied.
std::vector<PairedCells> PairsBy(std::span<const TrialRecord> records, const std::string& factor,
                                 const RowContext& context = {});

}  // namespace fenestra
