#include "experiments/cli/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/experiments/trial/record_examples.h"

namespace fenestra::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::RandomHit;
using testing::Row;

/// A clock that is set by hand, and what was written.
struct Desk {
  double now_s = 100.0;
  std::string text;

  Progress::Options Options(bool terminal, int columns = 200) {
    return {.terminal = terminal,
            .columns = columns,
            .seconds = [this] { return now_s; },
            .write = [this](const std::string& written) { text += written; }};
  }
};

void AddTrial(Progress& progress, Outcome second) {
  const std::vector<TrialRecord> rows = {RandomHit(0, 0, "a"), Row(0, 0, second, "b")};
  progress.Add(rows);
}

TEST(ProgressTest, ATerminalShowsRateRemainingTimeAndHitRates) {
  Desk desk;
  {
    Progress progress(desk.Options(true));
    progress.Start({.trials = 40, .stored = 0, .tallies = {}});
    for (int i = 0; i < 10; ++i) {
      desk.now_s += 0.5;
      AddTrial(progress, i < 5 ? Outcome::kMissed : Outcome::kHit);
    }
    AddTrial(progress, Outcome::kHit);  // Too soon to be shown.
    EXPECT_THAT(desk.text, AllOf(HasSubstr("10/40 trials  2.0/s  15 s left  hits: a 100 %, b 50 %"),
                                 Not(HasSubstr("\n")), Not(HasSubstr("11/40"))));
  }
  EXPECT_TRUE(desk.text.ends_with("\r\x1b[K"));
}

TEST(ProgressTest, ALineIsNeverLongerThanTheTerminalIsWide) {
  Desk desk;
  Progress progress(desk.Options(true, 30));
  progress.Start({.trials = 40, .stored = 0, .tallies = {}});
  EXPECT_EQ(desk.text.size(), std::string("\r\x1b[K").size() + 29);
}

TEST(ProgressTest, ElsewhereALineIsWrittenNowAndThen) {
  Desk desk;
  Progress progress(desk.Options(false));
  progress.Start({.trials = 7300, .stored = 0, .tallies = {}});
  for (int i = 0; i < 100; ++i) {
    desk.now_s += 1.0;
    AddTrial(progress, Outcome::kOutOfView);
  }
  EXPECT_EQ(std::count(desk.text.begin(), desk.text.end(), '\n'), 3);
  EXPECT_THAT(desk.text,
              AllOf(HasSubstr("90/7300 trials  1.0/s  2 h 00 min left  hits: a 100 %, b -\n"),
                    Not(HasSubstr("\r"))));
}

TEST(ProgressTest, AQuickRunSaysNothingAndAContinuedOneCountsOn) {
  Desk desk;
  Progress progress(desk.Options(false));
  progress.Start({.trials = 10, .stored = 0, .tallies = {}});
  AddTrial(progress, Outcome::kHit);
  EXPECT_THAT(desk.text, IsEmpty());

  Progress continued(desk.Options(false));
  continued.Start(
      {.trials = 10, .stored = 4, .tallies = {{.detector = "a", .in_view = 4, .hits = 1}}});
  EXPECT_THAT(desk.text, HasSubstr("4 of 10 trials are stored already"));
  desk.now_s += 60.0;
  AddTrial(continued, Outcome::kHit);
  // The rate is that of this run alone.
  EXPECT_THAT(desk.text, HasSubstr("5/10 trials  0.0/s  5 min 00 s left  hits: a 40 %, b 100 %"));
}

}  // namespace
}  // namespace fenestra::cli
