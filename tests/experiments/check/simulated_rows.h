#pragma once

#include <vector>

#include "core/random/random_stream.h"
#include "experiments/study/study.h"
#include "experiments/trial/trial_record.h"

namespace fenestra::testing {

/// A study with the cells that rows below may belong to: three distances, one stereo detector "a".
Study StudyOfThreeDistances(int repetitions);

/// What rows are drawn from: errors of N(0, sigma²) mm on each axis, and estimates only in a share
/// of the trials.
struct RowLaw {
  double sigma_mm = 10.0;
  double hit_rate = 0.95;
};

/// `trials` rows of each of the first `cells` cells; cells are independent of each other.
std::vector<TrialRecord> SimulatedRows(const RowLaw& law, int cells, int trials,
                                       const RandomStream& stream);

}  // namespace fenestra::testing
