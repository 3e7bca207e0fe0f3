#pragma once

#include <Eigen/Core>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "core/detection/detection.h"
#include "core/detection/observation.h"
#include "core/detection/stage_log.h"
#include "experiments/study/factors.h"
#include "experiments/study/outcome.h"

namespace fenestra {

/// One trial of a study.
struct TrialKey {
  int cell = 0;   ///< Index into Cells(study).
  int trial = 0;  ///< Index in the cell, from 0.

  // NOLINTNEXTLINE(modernize-use-nullptr): the 0 of the operator that the compiler makes.
  auto operator<=>(const TrialKey&) const = default;
};

/// A detection held against the truth. Frame C is the scored camera (see WindowEstimate); metres.
struct Score {
  Outcome outcome = Outcome::kMissed;
  /// Why there is no estimate: the reason of the Miss or the kind of the Crash; otherwise empty.
  std::string reason;
  std::string detail;  ///< Explains the reason to a person.
  /// Present whenever the detector gave a sane estimate, whatever the outcome.
  std::optional<WindowEstimate> estimate;
  /// Present whenever the scene has a target, in view or not.
  std::optional<Eigen::Vector3d> truth_p_CO;

  /// Estimate minus truth: x to the right, y down, z in depth. nullopt unless both are there.
  std::optional<Eigen::Vector3d> CentroidError_C() const;
  /// The length of CentroidError_C; infinite without an error, as the quantiles of all attempts
  /// need it.
  double CentroidErrorOrInfinity_m() const;

  bool HasTarget() const { return truth_p_CO.has_value(); }
  /// Whether there was a whole window in view to be found.
  bool IsAttempt() const { return HasTarget() && outcome != Outcome::kOutOfView; }
};

/// One raw row of a study: one trial seen by one detector. The key is (cell, trial, detector).
struct TrialRecord {
  int cell = 0;      ///< Index of the cell in the study.
  int trial = 0;     ///< Index of the trial in its cell.
  std::string part;  ///< Name of the study's part.
  SensorKind sensor = SensorKind::kStereo;
  std::string detector;  ///< Label of the detector.
  FactorValues levels;   ///< Shared by all trials of the cell.
  FactorValues drawn;    ///< Drawn anew in every trial.
  Score score;
  /// Cramér and Rao's bound on the covariance of an unbiased estimate of p_CO that knows what this
  /// detector knows [m²]; see docs/theory.md. Absent where theory gives none.
  std::optional<Eigen::Matrix3d> bound_C{};
  std::vector<StageTime> stages;

  /// Sum of the stage times; nullopt without any.
  std::optional<double> TotalSeconds() const;
};

}  // namespace fenestra
