#pragma once

#include <string>

#include "core/random/random_stream.h"
#include "experiments/trial/trial_record.h"

namespace fenestra::testing {

inline WindowEstimate EstimateAt(const Eigen::Vector3d& p_CO) {
  WindowEstimate estimate;
  estimate.p_CO = p_CO;
  estimate.p_CV = {p_CO + Eigen::Vector3d(-0.5, -0.5, 0.0), p_CO + Eigen::Vector3d(0.5, -0.5, 0.0),
                   p_CO + Eigen::Vector3d(0.5, 0.5, 0.0), p_CO + Eigen::Vector3d(-0.5, 0.5, 0.0)};
  return estimate;
}

/// A row whose truth is (0, 0, 2).
inline TrialRecord Row(int cell, int trial, Outcome outcome, const std::string& detector = "a") {
  TrialRecord row;
  row.cell = cell;
  row.trial = trial;
  row.part = "window";
  row.detector = detector;
  row.levels = {{"distance_m", 2.0 + cell}};
  row.score.outcome = outcome;
  if (outcome != Outcome::kFalseAlarm && outcome != Outcome::kClear) {
    row.score.truth_p_CO = Eigen::Vector3d(0.0, 0.0, 2.0);
  }
  if (outcome == Outcome::kMissed) row.score.reason = "no_contour";
  if (outcome == Outcome::kCrashed) row.score.reason = "exception";
  return row;
}

inline TrialRecord RowWithError(int cell, int trial, Outcome outcome,
                                const Eigen::Vector3d& error_C, const std::string& detector = "a") {
  TrialRecord row = Row(cell, trial, outcome, detector);
  row.score.estimate = EstimateAt(Eigen::Vector3d(0.0, 0.0, 2.0) + error_C);
  return row;
}

/// A row in which every field has digits: errors of 10 mm on each axis, all stages timed.
inline TrialRecord RandomHit(int cell, int trial, const std::string& detector = "a") {
  const RandomStream stream = RandomStream(7)
                                  .Child("cell", static_cast<uint64_t>(cell))
                                  .Child("trial", static_cast<uint64_t>(trial))
                                  .Child(detector);
  const Eigen::Vector3d error_C(stream.Normal(0), stream.Normal(1), stream.Normal(2));
  TrialRecord row = RowWithError(cell, trial, Outcome::kHit, 0.01 * error_C, detector);
  row.drawn = {{"yaw_deg", stream.Normal(3)}, {"glass", stream.Uniform(4) < 0.5}};
  row.score.estimate->covariance_C = Eigen::Matrix3d::Constant(stream.Normal(5));
  row.stages = {{"rectify", stream.Uniform(6)}, {"match", stream.Uniform(7)}};
  return row;
}

}  // namespace fenestra::testing
