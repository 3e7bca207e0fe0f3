#include "experiments/trial/trial_record.h"

#include <limits>

namespace fenestra {

std::optional<Eigen::Vector3d> Score::CentroidError_C() const {
  if (!estimate || !truth_p_CO) return std::nullopt;
  return Eigen::Vector3d(estimate->p_CO - *truth_p_CO);
}

double Score::CentroidErrorOrInfinity_m() const {
  const auto error = CentroidError_C();
  return error ? error->norm() : std::numeric_limits<double>::infinity();
}

std::optional<double> TrialRecord::TotalSeconds() const {
  if (stages.empty()) return std::nullopt;
  double total = 0.0;
  for (const StageTime& stage : stages) total += stage.seconds;
  return total;
}

}  // namespace fenestra
