#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/row_selection.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// What is measured in each row.
enum class Quantity {
  kError,        ///< Length of the centroid error [mm].
  kErrorX,       ///< To the right [mm], signed; likewise the next two.
  kErrorY,       ///< Down [mm].
  kErrorZ,       ///< In depth [mm].
  kErrorAcross,  ///< √(x² + y²) [mm].
  kTime,         ///< Sum of the stage times [ms].
};

/// "centroid_error_mm", "centroid_error_x_mm", ..., "centroid_error_across_mm", "time_ms".
const char* ToString(Quantity quantity);
const std::vector<Quantity>& AllQuantities();

/// A figure that a bound limits. Each has its rows:
///
///     rate(outcome)   share among the attempts with the target in view, of false_alarm and clear
///                     among the scenes without a target
///     pNN, median     quantile over all attempts in view, one without an estimate as +∞; of signed
///                     errors, of their absolute values; of time_ms, over all rows that are timed
///     rmse, bias      over the hits
struct Figure {
  enum class Kind { kRate, kQuantile, kRmse, kBias };

  Kind kind = Kind::kRate;
  Outcome outcome = Outcome::kHit;       ///< Of a rate.
  double level = 0.95;                   ///< Of a quantile; 0 < level < 1.
  Quantity quantity = Quantity::kError;  ///< Of all others.
};

/// One line of a file of bounds: a figure, a limit for it, the rows that it is taken over.
struct Bound {
  std::string text{};  ///< As written.
  int line = 0;        ///< In its file; 0 if it stands in none.
  Figure figure{};
  /// Figure ≤ limit, or figure ≥ limit.
  bool is_upper = true;
  double limit = 0.0;
  /// The limit is not the figure's own but that of its ratio (rmse) or difference (rate) to the
  /// same figure in the baseline.
  bool to_baseline = false;
  /// Probability that the bound is not said to hold when it does not.
  double confidence = 0.95;
  /// The figure of every cell is held against the limit, not that of all rows together.
  bool in_each_cell = false;
  std::vector<Condition> where{};
};

}  // namespace fenestra
