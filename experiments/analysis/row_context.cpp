#include "experiments/analysis/row_context.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "experiments/sampling/causes.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

constexpr double kConfidence = 0.95;

double DrawnOr(const FactorValues& drawn, const char* name, double otherwise) {
  const auto found =
      std::find_if(drawn.begin(), drawn.end(), [name](const auto& v) { return v.first == name; });
  return found == drawn.end() ? otherwise : std::get<double>(found->second);
}

std::optional<double> NormalisedSquare(const Score& score) {
  const auto error_C = score.CentroidError_C();
  if (!error_C || !score.estimate->covariance_C) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3d> covariance(*score.estimate->covariance_C);
  if (covariance.info() != Eigen::Success || !covariance.isPositive()) return std::nullopt;
  const double square = error_C->dot(covariance.solve(*error_C));
  return std::isfinite(square) ? std::optional(square) : std::nullopt;
}

}  // namespace

RowContext::RowContext(const Study& study, std::span<const Cell> cells)
    : has_study_(true), shares_replicates_(!study.independent_cells) {
  for (const Cell& cell : cells) {
    const auto& window = cell.settings.facade.window;
    const auto& until = study.parts[cell.part_index].until;
    cells_.push_back(
        {.causes = CausesOf(study, cell).size(),
         .width_m = window.width_m,
         .height_m = window.height_m,
         .confidence = until ? LookConfidence(kConfidence, until->CountLooks(cell.repetitions))
                             : kConfidence});
  }
}

MetricRow RowContext::Of(const TrialRecord& row) const {
  MetricRow result{.outcome = row.score.outcome,
                   .has_target = row.score.HasTarget(),
                   .cluster = {.cell = shares_replicates_ ? -1 : row.cell, .replicate = row.trial},
                   .error_C = row.score.CentroidError_C(),
                   .normalised_square = NormalisedSquare(row.score),
                   .side_m = SideOf(row)};
  if (row.bound_C) result.bound_variances_C = row.bound_C->diagonal();
  if (row.score.outcome != Outcome::kCrashed) result.seconds = row.TotalSeconds();
  const size_t causes = has_study_ ? cells_.at(static_cast<size_t>(row.cell)).causes : 0;
  if (causes > 0) {
    const PickFreezePlace place = PickFreezePlace::Of(row.trial, causes);
    result.cluster.replicate = place.row;
    result.cluster.draw = place.column == 1 ? 1 : 0;
    result.is_independent = place.column <= 1;
  }
  return result;
}

double RowContext::Confidence(int cell) const {
  return has_study_ ? cells_.at(static_cast<size_t>(cell)).confidence : kConfidence;
}

std::optional<double> RowContext::SideOf(const TrialRecord& row) const {
  if (!row.score.HasTarget()) return std::nullopt;
  if (has_study_) {
    const CellFacts& cell = cells_.at(static_cast<size_t>(row.cell));
    return std::min(DrawnOr(row.drawn, "window_width_m", cell.width_m),
                    DrawnOr(row.drawn, "window_height_m", cell.height_m));
  }
  const auto found = side_m_.find({row.cell, row.trial});
  return found == side_m_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace fenestra
