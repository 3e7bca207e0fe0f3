#include "experiments/analysis/trial_plan.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "core/random/random_stream.h"
#include "experiments/statistics/intervals.h"
#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

// Whether the detector finds the window in a trial of a cell.
using Finds = std::function<bool(const Cell&, int trial)>;
using Store = std::map<TrialKey, TrialRecord>;

TrialRecord Row(const Cell& cell, TrialKey key, bool found) {
  TrialRecord row;
  row.cell = key.cell;
  row.trial = key.trial;
  row.part = cell.part;
  row.sensor = cell.sensor;
  row.detector = "d";
  row.levels = cell.levels;
  row.score.truth_p_CO = Eigen::Vector3d(0, 0, 3);
  row.score.outcome = found ? Outcome::kHit : Outcome::kMissed;
  if (found) {
    WindowEstimate estimate;
    estimate.p_CO = Eigen::Vector3d(0, 0, 3.01);
    row.score.estimate = estimate;
  }
  return row;
}

TrialPlan PlanOf(const Study& study, std::span<const Cell> cells, const Store& store) {
  TrialPlan plan(study, cells);
  for (const auto& [key, row] : store) plan.Add(row);
  return plan;
}

// Runs a study to its end, or for so many steps; each step makes every `stride`-th wanted trial
// only, as a run that is killed does.
Store RunThrough(const Study& study, const Finds& finds, Store store = {}, size_t stride = 1,
                 int steps = 1000) {
  const std::vector<Cell> cells = Cells(study);
  for (int step = 0; step < steps; ++step) {
    const std::vector<TrialKey> wanted = PlanOf(study, cells, store).Next();
    if (wanted.empty()) break;
    for (size_t i = 0; i < wanted.size(); i += stride) {
      EXPECT_FALSE(store.contains(wanted[i]));
      const Cell& cell = cells[static_cast<size_t>(wanted[i].cell)];
      store[wanted[i]] = Row(cell, wanted[i], finds(cell, wanted[i].trial));
    }
  }
  return store;
}

std::vector<TrialKey> Keys(const Store& store) {
  std::vector<TrialKey> keys;
  for (const auto& [key, row] : store) keys.push_back(key);
  return keys;
}

std::map<int, int> TrialsByCell(const Store& store) {
  std::map<int, int> trials;
  for (const auto& [key, row] : store) ++trials[key.cell];
  return trials;
}

Finds Randomly(double rate, uint64_t seed = 1) {
  return [rate, seed](const Cell& cell, int trial) {
    return RandomStream(seed)
               .Child("cell", static_cast<uint64_t>(cell.index))
               .Uniform(static_cast<uint64_t>(trial)) < rate;
  };
}

const char* const kPlain = R"(
name: test
sensors: [rgbd]
repetitions: 300
factors: {distance_m: [2, 3]}
)";

const std::string kUntil = std::string(kPlain) + "until: {hit_rate: 0.2, first_look: 20}\n";

const char* const kEnvelope = R"(
name: test
sensors: [rgbd]
repetitions: 80
envelope: {over: distance_m, require: {hit_rate: 0.95}}
factors: {azimuth_deg: [0, 30], distance_m: {from: 1, to: 9, step: 0.25}}
)";

// Sees up to 6.5 m, from the side up to 3 m.
bool SeesNear(const Cell& cell, int) {
  const double far = cell.settings.viewpoint.azimuth_rad > 0.1 ? 3.0 : 6.5;
  return cell.settings.viewpoint.distance_m < far + 1e-9;
}

TEST(TrialPlan, APlainStudyWantsAllItsTrialsAtOnce) {
  const Study study = ReadText(kPlain);
  const std::vector<Cell> cells = Cells(study);
  const TrialPlan plan(study, cells);
  EXPECT_EQ(plan.Next().size(), 600u);
  EXPECT_EQ(plan.most_trials(), 600);
  EXPECT_TRUE(PlanOf(study, cells, RunThrough(study, Randomly(0.5))).Next().empty());
}

TEST(TrialPlan, ACellStopsAtTheFirstLookThatIsNarrowEnough) {
  const Study study = ReadText(kUntil);
  const std::vector<int> looks = Looks(20, 300);
  const double confidence = LookConfidence(0.95, static_cast<int>(looks.size()));
  const Store store = RunThrough(study, Randomly(0.9));
  for (const auto& [cell, trials] : TrialsByCell(store)) {
    int expected = 0;
    for (const int look : looks) {
      int hits = 0;
      for (int i = 0; i < look; ++i) {
        hits += store.at({cell, i}).score.outcome == Outcome::kHit ? 1 : 0;
      }
      expected = look;
      const Interval interval = ClopperPearson(hits, look, confidence);
      if (interval.upper - interval.lower <= 0.2) break;
    }
    EXPECT_EQ(trials, expected);
    EXPECT_LT(trials, 300);
  }
}

TEST(TrialPlan, AtTheLatestItStopsAfterAllRepetitions) {
  const Study study = ReadText(std::string(kPlain) + "until: {hit_rate: 0.01}\n");
  for (const auto& [cell, trials] : TrialsByCell(RunThrough(study, Randomly(0.5)))) {
    EXPECT_EQ(trials, 300);
  }
}

TEST(TrialPlan, ARunThatWasKilledEndsWithTheSameTrials) {
  for (const std::string& text : {kUntil, std::string(kEnvelope)}) {
    const Study study = ReadText(text);
    const Finds finds = text == kUntil ? Randomly(0.85) : Finds(SeesNear);
    const std::vector<TrialKey> undisturbed = Keys(RunThrough(study, finds));
    for (const int steps : {1, 2, 3, 5}) {
      const Store partial = RunThrough(study, finds, {}, 3, steps);
      EXPECT_EQ(Keys(RunThrough(study, finds, partial)), undisturbed) << steps;
    }
  }
}

// Whatever the true rate, the interval at which a study stops covers it as often as it says.
TEST(TrialPlan, StoppingEarlyKeepsTheConfidence) {
  const Study study = ReadText(kUntil);
  const std::vector<Cell> cells = Cells(study);
  const RowContext context(study, cells);
  int wrong = 0;
  constexpr int kRuns = 150;
  for (uint64_t seed = 0; seed < kRuns; ++seed) {
    const Store store = RunThrough(study, Randomly(0.9, seed));
    for (const auto& [cell, trials] : TrialsByCell(store)) {
      int hits = 0;
      for (int i = 0; i < trials; ++i) {
        hits += store.at({cell, i}).score.outcome == Outcome::kHit ? 1 : 0;
      }
      const Interval interval = ClopperPearson(hits, trials, context.Confidence(cell));
      wrong += interval.lower <= 0.9 && 0.9 <= interval.upper ? 0 : 1;
    }
  }
  // Of 300 cells at most 15 are expected; standard deviation 3.8; four: 3e-5.
  EXPECT_LE(wrong, 30);
}

TEST(TrialPlan, AnEnvelopeRunsThePartOfTheGridThatItNeeds) {
  const Study study = ReadText(kEnvelope);
  const std::vector<Cell> cells = Cells(study);
  const Store store = RunThrough(study, SeesNear);
  const TrialPlan plan = PlanOf(study, cells, store);
  EXPECT_TRUE(plan.Next().empty());
  const std::vector<EnvelopeCurve> envelopes = plan.Envelopes();
  ASSERT_EQ(envelopes.size(), 2u);
  ASSERT_EQ(envelopes[0].holds.size(), 1u);
  EXPECT_EQ(envelopes[0].holds[0].from, 1.0);
  EXPECT_EQ(envelopes[0].holds[0].to, 6.5);
  EXPECT_EQ(envelopes[0].holds[0].fails_above, 6.75);
  EXPECT_EQ(envelopes[1].holds[0].to, 3.0);
  for (const EnvelopeCurve& envelope : envelopes) {
    EXPECT_LE(envelope.tested_levels, 5 + 3);  // Of 33.
  }
  // A level that can no longer hold gets the first look's ten trials.
  for (const auto& [cell, trials] : TrialsByCell(store)) {
    EXPECT_EQ(trials, SeesNear(cells[static_cast<size_t>(cell)], 0) ? 80 : 10);
  }
}

}  // namespace
}  // namespace fenestra
