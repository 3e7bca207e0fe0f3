#include "experiments/sampling.h"

#include "core/check.h"

namespace fenestra {

RandomStream TrialStream(const Study& study, const Cell& cell, int trial_index) {
  FENESTRA_CHECK(trial_index >= 0, "a trial's index counts from 0");
  RandomStream root(study.seed);
  if (study.independent_cells) root = root.Child("cell", static_cast<uint64_t>(cell.index));
  return root.Child("replicate", static_cast<uint64_t>(trial_index));
}

Trial SampleTrial(const Study& study, const Cell& cell, int trial_index) {
  Trial trial{.index = trial_index,
              .settings = cell.settings,
              .drawn = {},
              .stream = TrialStream(study, cell, trial_index)};
  for (const auto& [factor, distribution] : DrawnFactors(study, cell)) {
    const double u = trial.stream.Child("factor:" + factor).Uniform(0);
    const double value = Quantile(distribution, u);
    Factors().Set(trial.settings, factor, value);
    trial.drawn.emplace_back(factor, value);
  }
  return trial;
}

}  // namespace fenestra
