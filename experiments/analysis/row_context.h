#pragma once

#include <compare>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "experiments/study/study.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// Rows with equal keys share random numbers; rows with different ones are independent. A trial's
/// detectors always share theirs. Under common random numbers (the default) so does a replicate in
/// all cells of its study, so that the key names no cell; with `independent_cells` it does.
struct ClusterKey {
  int cell = -1;      ///< -1: of all cells.
  int replicate = 0;  ///< The trial, or the row of a sensitivity design.
  int draw = 0;       ///< 1: the second draw of all causes of that row.

  // NOLINTNEXTLINE(modernize-use-nullptr): the 0 of the operator that the compiler makes.
  auto operator<=>(const ClusterKey&) const = default;
};

/// What the metrics need of a row. Lengths in metres, times in seconds.
struct MetricRow {
  Outcome outcome = Outcome::kMissed;
  bool has_target = false;
  /// Whether the row is a cluster's own. In a sensitivity design, rows that exchange one cause
  /// alone repeat the draws of the two that exchange none or all; intervals leave them out.
  bool is_independent = true;
  ClusterKey cluster{};
  std::optional<Eigen::Vector3d> error_C{};
  std::optional<Eigen::Vector3d> bound_variances_C{};
  std::optional<double> normalised_square{};  ///< eᵀ Σ⁻¹ e; see Quantity::kNormalisedSquare.
  std::optional<double> side_m{};             ///< Smaller one of the target's width and height.
  std::optional<double> seconds{};            ///< Absent of a crash.

  bool IsAttempt() const { return has_target && outcome != Outcome::kOutOfView; }
};

/// What a result knows of its rows beyond what each says of itself.
class RowContext {
 public:
  /// Of rows that belong to no study: every trial of a cell is independent, sides are unknown.
  RowContext() = default;
  /// Of a recorded sequence: the side of the target of each frame by cell and trial.
  explicit RowContext(std::map<std::pair<int, int>, double> side_m) : side_m_(std::move(side_m)) {}
  /// Of a study and its cells.
  RowContext(const Study& study, std::span<const Cell> cells);

  MetricRow Of(const TrialRecord& row) const;

  /// The confidence that an interval of this cell must have so that 95 % is true of it: more than
  /// 0.95 where the cell may have stopped early (LookConfidence).
  double Confidence(int cell) const;

 private:
  struct CellFacts {
    size_t causes = 0;  ///< Of a sensitivity design; 0 with other designs.
    double width_m = 0.0;
    double height_m = 0.0;
    double confidence = 0.95;
  };

  std::optional<double> SideOf(const TrialRecord& row) const;

  bool has_study_ = false;
  bool shares_replicates_ = false;
  std::vector<CellFacts> cells_;
  std::map<std::pair<int, int>, double> side_m_;
};

}  // namespace fenestra
