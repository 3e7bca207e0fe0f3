#include "experiments/analysis/error_budget.h"

#include <algorithm>

#include "experiments/sampling/causes.h"
#include "experiments/statistics/clustered_intervals.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {
namespace {

constexpr const char* kCoordinates[] = {"right", "down", "depth"};

// That of the root mean square about the mean, which is √((n - 1) / n) of the standard deviation.
std::optional<Interval> DeviationInterval(std::span<const double> values,
                                          const RandomStream& resampling) {
  const double mean = Mean(values);
  std::vector<double> deviations(values.begin(), values.end());
  for (double& value : deviations) value -= mean;
  auto interval = RootMeanSquareInterval(deviations, resampling);
  if (!interval) return std::nullopt;
  const double scale = StandardDeviation(values) / RootMeanSquare(deviations);
  return Interval{scale * interval->lower, scale * interval->upper};
}

// The rows of the design that are hits throughout, as their trials.
std::vector<int> RowsOfHits(const std::vector<std::optional<Eigen::Vector3d>>& errors,
                            int columns) {
  std::vector<int> rows;
  const int whole = static_cast<int>(errors.size()) / columns;
  for (int row = 0; row < whole; ++row) {
    const auto begin = errors.begin() + static_cast<std::ptrdiff_t>(row) * columns;
    if (std::all_of(begin, begin + columns, [](const auto& error) { return error.has_value(); })) {
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace

ErrorBudgets::ErrorBudgets(const Study& study, std::span<const Cell> cells) : seed_(study.seed) {
  for (const Cell& cell : cells) {
    std::vector<std::string> names;
    for (const Cause& cause : CausesOf(study, cell)) names.push_back(cause.name);
    causes_.push_back(std::move(names));
  }
}

void ErrorBudgets::Add(const TrialRecord& record) {
  if (causes_.at(static_cast<size_t>(record.cell)).empty()) return;
  Errors& cell = errors_[{record.cell, record.detector}];
  if (cell.trials++ == 0) cell.first = record;
  const auto trial = static_cast<size_t>(record.trial);
  if (cell.errors.size() <= trial) cell.errors.resize(trial + 1);
  if (record.score.outcome == Outcome::kHit) cell.errors[trial] = record.score.CentroidError_C();
}

ErrorBudget ErrorBudgets::BudgetOf(const Errors& collected) const {
  const TrialRecord& first = collected.first;
  ErrorBudget budget;
  budget.cell = first.cell;
  budget.part = first.part;
  budget.sensor = first.sensor;
  budget.detector = first.detector;
  budget.levels = first.levels;
  budget.causes = causes_[static_cast<size_t>(first.cell)];
  budget.trials = collected.trials;
  budget.hits =
      static_cast<int>(std::count_if(collected.errors.begin(), collected.errors.end(),
                                     [](const auto& error) { return error.has_value(); }));
  const int columns = PickFreezeColumns(budget.causes.size());
  const std::vector<int> rows = RowsOfHits(collected.errors, columns);
  budget.rows = static_cast<int>(collected.errors.size()) / columns;
  budget.used_rows = static_cast<int>(rows.size());
  const RandomStream resampling = RandomStream(seed_).Child("sobol_indices");
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Eigen::MatrixXd errors(budget.used_rows, columns);
    for (Eigen::Index r = 0; r < errors.rows(); ++r) {
      for (Eigen::Index c = 0; c < errors.cols(); ++c) {
        const auto trial = static_cast<size_t>(rows[static_cast<size_t>(r)] * columns + c);
        errors(r, c) = (*collected.errors[trial])[axis];
      }
    }
    CoordinateBudget coordinate;
    coordinate.coordinate = kCoordinates[axis];
    if (errors.rows() >= 2) {
      // Columns A and B alone are independent of each other.
      const std::span<const double> independent(errors.data(),
                                                static_cast<size_t>(2 * errors.rows()));
      coordinate.mean_m = Mean(independent);
      coordinate.mean_interval_m = MeanInterval(independent);
      coordinate.standard_deviation_m = StandardDeviation(independent);
      coordinate.standard_deviation_interval_m =
          DeviationInterval(independent, RandomStream(seed_).Child("standard_deviation"));
      coordinate.indices = SobolIndices(errors, resampling);
    }
    budget.coordinates.push_back(std::move(coordinate));
  }
  return budget;
}

std::vector<ErrorBudget> ErrorBudgets::Budgets() const {
  std::vector<ErrorBudget> budgets;
  for (const auto& [key, errors] : errors_) budgets.push_back(BudgetOf(errors));
  return budgets;
}

}  // namespace fenestra
