#include "tests/experiments/check/simulated_rows.h"

#include "experiments/study_file/study_reader.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra::testing {

Study StudyOfThreeDistances(int repetitions) {
  static const std::vector<DetectorInfo> kKnown = {{"a", SensorKind::kStereo, "", {}}};
  return ReadStudy(YamlReader::FromText("name: simulated\n"
                                        "independent_cells: true\n"
                                        "sensors: [stereo]\n"
                                        "factors: {distance_m: [2, 3, 4]}\n"
                                        "parts: [{name: window}]\n"
                                        "repetitions: " +
                                            std::to_string(repetitions) + "\n",
                                        "study.yaml"),
                   kKnown);
}

std::vector<TrialRecord> SimulatedRows(const RowLaw& law, int cells, int trials,
                                       const RandomStream& stream) {
  std::vector<TrialRecord> rows;
  for (int cell = 0; cell < cells; ++cell) {
    for (int trial = 0; trial < trials; ++trial) {
      const RandomStream own = stream.Child("cell", static_cast<uint64_t>(cell))
                                   .Child("trial", static_cast<uint64_t>(trial));
      if (own.Uniform(0) < law.hit_rate) {
        const Eigen::Vector3d error_mm(own.Normal(1), own.Normal(2), own.Normal(3));
        rows.push_back(RowWithError(cell, trial, Outcome::kHit, 1e-3 * law.sigma_mm * error_mm));
      } else {
        rows.push_back(Row(cell, trial, Outcome::kMissed));
      }
    }
  }
  return rows;
}

}  // namespace fenestra::testing
