#include "vision/external/external_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "core/detection/detector.h"
#include "core/io/input_error.h"
#include "core/io/system_error.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;

CameraModel SmallCamera() {
  return CameraModel({.width_px = 32,
                      .height_px = 24,
                      .fx_px = 30.0,
                      .fy_px = 30.0,
                      .cx_px = 15.5,
                      .cy_px = 11.5,
                      .distortion = {}});
}

StereoCalibration Calibration() {
  return {SmallCamera(), SmallCamera(), Pose(Eigen::Matrix3d::Identity(), {-0.35, 0.0, 0.0})};
}

StereoObservation Observed(int grey) {
  return {cv::Mat1b(24, 32, static_cast<uchar>(grey)), cv::Mat1b(24, 32, uchar{7})};
}

ExternalCommand Fake(const std::string& how, const std::string& when = "always") {
  return {.words = {FENESTRA_FAKE_DETECTOR, how, when}, .time_limit_s = 0.5, .start_limit_s = 5.0};
}

/// Hands three observations to one pool: what became of each, "window", "miss" or the failure's
/// kind.
std::vector<std::string> ThreeAnswers(const ExternalCommand& command) {
  const ExternalDetector detector(std::make_shared<ProgramPool>(command), Calibration());
  std::vector<std::string> answers;
  for (const int grey : {10, 20, 30}) {
    StageLog log([] { return 0.0; });
    try {
      const Detection detection = detector.Detect(Observed(grey), log);
      answers.push_back(std::holds_alternative<Miss>(detection) ? "miss" : "window");
    } catch (const DetectorFailure& failure) {
      answers.push_back(failure.kind());
    }
  }
  return answers;
}

TEST(ExternalDetectorTest, AnswersKeepEveryBitAndTheTimeIsTaken) {
  const ExternalDetector detector(std::make_shared<ProgramPool>(Fake("fine")), Calibration());
  StageLog log([] { return 0.0; });
  const auto estimate = std::get<WindowEstimate>(detector.Detect(Observed(1), log));
  EXPECT_EQ(estimate.p_CO.z(), 1.0 / 3.0 + 1.5);
  EXPECT_TRUE(std::signbit(estimate.p_CO.y()));
  EXPECT_EQ(estimate.normal_C, Eigen::Vector3d(0.0, 0.0, -1.0));  // Of the corners.
  ASSERT_EQ(log.times().size(), 1u);
  EXPECT_EQ(log.times()[0].stage, "answer");
  EXPECT_GT(log.TotalSeconds(), 0.0);
}

TEST(ExternalDetectorTest, StagesOfTheProgramReplaceTheTimeThatWasTaken) {
  const ExternalDetector detector(std::make_shared<ProgramPool>(Fake("stages")), Calibration());
  StageLog log([] { return 0.0; });
  detector.Detect(Observed(1), log);
  EXPECT_EQ(log.TotalSeconds(), 0.75);
}

struct Fault {
  const char* how;
  const char* kind;
};

class FaultyDetectorTest : public ::testing::TestWithParam<Fault> {};

TEST_P(FaultyDetectorTest, CostsExactlyTheObservationInWhichItHappens) {
  // In its second observation; a program that was stopped begins to count again.
  const std::vector<std::string> answers = ThreeAnswers(Fake(GetParam().how, "2"));
  EXPECT_EQ(answers, (std::vector<std::string>{"window", GetParam().kind, "window"}));
}

INSTANTIATE_TEST_SUITE_P(EachKind, FaultyDetectorTest,
                         ::testing::Values(Fault{"crash", "died"}, Fault{"exit", "died"},
                                           Fault{"hang", "timeout"}, Fault{"deaf", "timeout"},
                                           Fault{"flood", "flood"}, Fault{"flood_errors", "flood"},
                                           Fault{"twice", "flood"}, Fault{"bad_json", "bad_json"},
                                           Fault{"nan", "bad_json"}, Fault{"binary", "bad_json"},
                                           Fault{"wrong_id", "wrong_id"},
                                           Fault{"wrong_shape", "bad_answer"},
                                           Fault{"no_centroid", "bad_answer"},
                                           Fault{"error", "exception"}, Fault{"miss", "miss"}),
                         [](const auto& test) { return std::string(test.param.how); });

class NonsenseTest : public ::testing::TestWithParam<Fault> {};

TEST_P(NonsenseTest, EndsTheProgram) {
  // Wrong from its second observation on: only another program answers the third one.
  const std::vector<std::string> answers = ThreeAnswers(Fake(GetParam().how, "2+"));
  EXPECT_EQ(answers, (std::vector<std::string>{"window", GetParam().kind, "window"}));
}

INSTANTIATE_TEST_SUITE_P(EachKind, NonsenseTest,
                         ::testing::Values(Fault{"twice", "flood"}, Fault{"bad_json", "bad_json"},
                                           Fault{"nan", "bad_json"}, Fault{"binary", "bad_json"},
                                           Fault{"wrong_id", "wrong_id"},
                                           Fault{"wrong_shape", "bad_answer"},
                                           Fault{"no_centroid", "bad_answer"}),
                         [](const auto& test) { return std::string(test.param.how); });

TEST(ExternalDetectorTest, AnOrderlyAnswerKeepsTheProgram) {
  EXPECT_EQ(ThreeAnswers(Fake("error", "2+")),
            (std::vector<std::string>{"window", "exception", "exception"}));
  EXPECT_EQ(ThreeAnswers(Fake("miss", "2+")), (std::vector<std::string>{"window", "miss", "miss"}));
}

TEST(ExternalDetectorTest, AFailureSaysHowTheProgramEnded) {
  const ExternalDetector detector(std::make_shared<ProgramPool>(Fake("crash")), Calibration());
  StageLog log([] { return 0.0; });
  try {
    detector.Detect(Observed(1), log);
    FAIL();
  } catch (const DetectorFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("signal 11"));
    EXPECT_THAT(failure.what(), HasSubstr("about to end"));
  }
}

TEST(ExternalDetectorTest, ASlowStartIsNoTimeout) {
  // The fake needs 0.7 s to start and has 0.5 s for an answer.
  EXPECT_EQ(ThreeAnswers(Fake("slow_start", "99")),
            (std::vector<std::string>{"window", "window", "window"}));
}

// A clean-up of temporary files, or the end of a session, may take a program's observation away.
TEST(ExternalDetectorTest, AnObservationThatOthersRemoveIsHandedOverAgain) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(ThreeAnswers(Fake("cleared", folder / "mark")),
            (std::vector<std::string>{"window", "window", "window"}));
  EXPECT_THROW(ThreeAnswers(Fake("cleared")), SystemError);
}

TEST(ExternalDetectorTest, WhatCannotStartIsAnInputError) {
  const auto complaint = [](ExternalCommand command) -> std::string {
    command.start_limit_s = 0.5;
    try {
      ProgramPool(command).Start();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint({.words = {"/no/such/program"}}), HasSubstr("cannot be started"));
  EXPECT_THAT(complaint({.words = {FENESTRA_SOURCE_DIR "/README.md"}}),
              HasSubstr("cannot be started"));
  EXPECT_THAT(complaint(Fake("no_hello")), HasSubstr("no answer within 0.5 s"));
  EXPECT_THAT(complaint(Fake("refuse")), HasSubstr("size_m must be positive"));
  EXPECT_THAT(complaint(Fake("other_protocol")), HasSubstr("protocol 2"));
  EXPECT_THAT(complaint({.words = {"cat"}}), HasSubstr("repeats the request"));
  EXPECT_THAT(complaint({.words = {"true"}}), HasSubstr("exit code 0"));
  EXPECT_EQ(complaint(Fake("fine")), "");
}

/// As /proc says: 'S' sleeping, 'Z' dead and not reaped; 'X' where there is no such process.
char StateOf(int process) {
  FILE* const file = fopen(("/proc/" + std::to_string(process) + "/stat").c_str(), "r");
  if (file == nullptr) return 'X';
  char state = 'X';
  EXPECT_EQ(fscanf(file, "%*d %*s %c", &state), 1);
  fclose(file);
  return state;
}

TEST(ExternalDetectorTest, NothingOfAProgramOutlivesIt) {
  // The shell starts a child that would sleep for an hour, and hangs in the first observation.
  const std::string script =
      "sleep 3600 & echo $! > " + ::testing::TempDir() + "/sleeper; exec \"$0\" hang";
  ThreeAnswers({.words = {"sh", "-c", script, FENESTRA_FAKE_DETECTOR}, .time_limit_s = 0.2});
  FILE* const file = fopen((::testing::TempDir() + "/sleeper").c_str(), "r");
  int sleeper = 0;
  ASSERT_EQ(fscanf(file, "%d", &sleeper), 1);
  fclose(file);
  // Killed, which takes a moment; init reaps it some time later, if there is one that does.
  char state = 'R';
  for (int tenths = 0; tenths < 50 && state != 'Z' && state != 'X'; ++tenths) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    state = StateOf(sleeper);
  }
  EXPECT_THAT(state, ::testing::AnyOf('Z', 'X'));
  EXPECT_LT(waitpid(-1, nullptr, WNOHANG), 0);  // No child of ours is left, not even a dead one.
}

}  // namespace
}  // namespace fenestra
