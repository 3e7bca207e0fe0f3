#pragma once

#include "core/random_stream.h"
#include "experiments/study.h"

namespace fenestra {

/// One point of a study, ready to be simulated.
struct Trial {
  int index;  ///< In its cell, from 0.
  TrialSettings settings;
  FactorValues drawn;   ///< What the distributions gave in this trial.
  RandomStream stream;  ///< The root of all other randomness of this trial.
};

/// The root of a trial's randomness: a function of the seed and the trial's index in its cell,
/// and of the cell only if the study asks for independent cells. All detectors share it.
RandomStream TrialStream(const Study& study, const Cell& cell, int trial_index);

/// Draws the trial. A factor's value is the quantile, at a uniform number that depends on the
/// trial's stream and the factor's name alone, of its distribution: cells that draw the same
/// factor from different distributions are compared at the same ranks.
/// `trial_index` may exceed the cell's repetitions.
Trial SampleTrial(const Study& study, const Cell& cell, int trial_index);

}  // namespace fenestra
