#include "experiments/sampling/causes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/sampling/trial_sampler.h"
#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

const char* const kStudy = R"(
name: test
repetitions: 70
design: sensitivity
factors:
  yaw_deg: {uniform: [0, 1]}
  pitch_deg: {uniform: [0, 1]}
  sky_illuminance_lx: {log_uniform: [10, 10000]}
  frame_reflectance: {uniform: [0.02, 0.2]}
  stereo_read_noise_e: {uniform: [1, 9]}
)";

// What a trial's sources gave, by name.
std::map<std::string, double> Sources(const Trial& trial) {
  std::map<std::string, double> values{{kShotSource, trial.streams.shot.Uniform(0)},
                                       {kRigSource, trial.streams.rig.Uniform(0)},
                                       {kCalibrationSource, trial.streams.calibration.Uniform(0)}};
  for (const auto& [name, value] : trial.drawn) values[name] = std::get<double>(value);
  return values;
}

TEST(Causes, AreByDefaultWhatTheFactorsBelongTo) {
  const Study study = ReadText(kStudy);
  const std::vector<Cell> cells = Cells(study);
  EXPECT_EQ(CausesOf(study, cells[0]), (std::vector<Cause>{{"noise", {"shot"}},
                                                           {"calibration", {"rig", "calibration"}},
                                                           {"pose", {"yaw_deg", "pitch_deg"}},
                                                           {"light", {"sky_illuminance_lx"}},
                                                           {"scene", {"frame_reflectance"}},
                                                           {"sensor", {"stereo_read_noise_e"}}}));
  EXPECT_EQ(CausesOf(study, cells[1]), (std::vector<Cause>{{"noise", {"shot"}},
                                                           {"calibration", {"rig"}},
                                                           {"pose", {"yaw_deg", "pitch_deg"}},
                                                           {"light", {"sky_illuminance_lx"}},
                                                           {"scene", {"frame_reflectance"}}}));
}

TEST(Causes, ASharedRigIsNone) {
  const Study study =
      ReadText(std::string(kStudy) + "  stereo_rig_per_trial: false\nsensors: [stereo]\n");
  for (const Cause& cause : CausesOf(study, Cells(study)[0])) EXPECT_NE(cause.name, "calibration");
  // Nor is a sensor that is exactly as told.
  const Study exact = ReadText(std::string(kStudy) + "  rgbd_calibration: exact\n");
  for (const Cause& cause : CausesOf(exact, Cells(exact)[1])) EXPECT_NE(cause.name, "calibration");
}

// Column 2 + i of a row differs from column 0 in the sources of cause i and in nothing else, and
// has the values of column 1 there; columns 0 and 1 differ in all.
TEST(PickFreeze, ARowExchangesOneCauseAtATime) {
  const Study study = ReadText(kStudy);
  for (const Cell& cell : Cells(study)) {
    const TrialSampler sampler(study, cell);
    const std::vector<Cause> causes = CausesOf(study, cell);
    const int columns = PickFreezeColumns(causes.size());
    for (int row = 0; row < 5; ++row) {
      const auto first = Sources(sampler.Sample(row * columns));
      const auto second = Sources(sampler.Sample(row * columns + 1));
      for (size_t i = 0; i < causes.size(); ++i) {
        auto expected = first;
        for (const std::string& source : causes[i].sources) {
          EXPECT_NE(first.at(source), second.at(source)) << source;
          expected[source] = second.at(source);
        }
        EXPECT_EQ(Sources(sampler.Sample(row * columns + 2 + static_cast<int>(i))), expected)
            << causes[i].name;
      }
    }
  }
}

TEST(PickFreeze, RowsAreIndependent) {
  const Study study = ReadText(kStudy);
  const TrialSampler sampler(study, Cells(study)[0]);
  std::set<double> shots;
  for (int row = 0; row < 50; ++row) {
    for (const int column : {0, 1})
      shots.insert(sampler.Sample(8 * row + column).streams.shot.Uniform(0));
  }
  EXPECT_EQ(shots.size(), 100u);
}

}  // namespace
}  // namespace fenestra
