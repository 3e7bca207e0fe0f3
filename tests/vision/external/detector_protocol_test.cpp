#include "vision/external/detector_protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "core/detection/detector.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;

ExternalCommand Command() {
  return {.words = {"python3", "my detector.py"},
          .sensor = SensorKind::kRgbd,
          .options = {{"size_m", 0.1}, {"robust", true}, {"method", std::string("a \"b\"\nc")}}};
}

// A window in which every number has digits.
TimedDetection Window() {
  WindowEstimate estimate;
  estimate.p_CO = {1.0 / 3.0, -2.0 / 7.0, 3.1};
  for (size_t i = 0; i < 4; ++i) {
    estimate.p_CV[i] =
        estimate.p_CO + Eigen::Vector3d(0.1 * static_cast<double>(i), 1.0 / 9.0, 0.0);
  }
  estimate.normal_C = Eigen::Vector3d(0.1, 0.2, -1.0).normalized();
  estimate.covariance_C = Eigen::Matrix3d::Identity() / 7e6;
  estimate.score = 2.0 / 3.0;
  return {.detection = estimate, .stages = {{"match", 0.01}, {"fit", 1.0 / 700.0}}};
}

// The kind of the DetectorFailure that `run` throws.
std::string KindOf(const std::function<void()>& run) {
  try {
    run();
  } catch (const DetectorFailure& failure) {
    return failure.kind();
  }
  return "none";
}

std::string HelloKind(const std::string& line) {
  return KindOf([&] { CheckHelloAnswer(line); });
}

std::string AnswerKind(const std::string& line) {
  return KindOf([&] { ParseDetectAnswer(line, 7); });
}

TEST(DetectorProtocol, AHelloArrivesAsItWasSent) {
  const std::string line = HelloRequest(Command());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const Hello hello = std::get<Hello>(ParseRequest(line));
  EXPECT_EQ(hello.protocol, kDetectorProtocol);
  EXPECT_EQ(hello.sensor, SensorKind::kRgbd);
  EXPECT_EQ(hello.options, Command().options);
}

TEST(DetectorProtocol, AnOrderArrivesAsItWasSent) {
  for (const SensorKind sensor : {SensorKind::kStereo, SensorKind::kRgbd}) {
    const ObservationFiles files = ObservationFiles::In("/dev/shm/a folder", sensor);
    const auto order = std::get<DetectOrder>(ParseRequest(DetectRequest(1234567890123, files)));
    EXPECT_EQ(order.id, 1234567890123);
    EXPECT_EQ(order.files.sensor, sensor);
    EXPECT_EQ(order.files.left, files.left);
    EXPECT_EQ(order.files.right, files.right);
    EXPECT_EQ(order.files.color, files.color);
    EXPECT_EQ(order.files.depth, files.depth);
    EXPECT_EQ(order.files.calibration, files.calibration);
  }
}

TEST(DetectorProtocol, AWindowArrivesToTheLastBit) {
  const TimedDetection sent = Window();
  const std::string line = DetectAnswer(7, sent);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const TimedDetection read = ParseDetectAnswer(line, 7);
  const auto& before = std::get<WindowEstimate>(sent.detection);
  const auto& after = std::get<WindowEstimate>(read.detection);
  EXPECT_EQ(after.p_CO, before.p_CO);
  EXPECT_EQ(after.p_CV, before.p_CV);
  EXPECT_EQ(after.normal_C, before.normal_C);
  EXPECT_EQ(after.covariance_C.value(), before.covariance_C.value());
  EXPECT_EQ(after.score, before.score);
  ASSERT_EQ(read.stages.size(), 2u);
  EXPECT_EQ(read.stages[1].stage, "fit");
  EXPECT_EQ(read.stages[1].seconds, 1.0 / 700.0);
}

TEST(DetectorProtocol, AMissArrivesWithItsReason) {
  const TimedDetection miss{.detection = Miss{"no_contour", "2 contours \xff, none closed"},
                            .stages = {}};
  const TimedDetection read = ParseDetectAnswer(DetectAnswer(7, miss), 7);
  EXPECT_EQ(std::get<Miss>(read.detection).reason, "no_contour");
  // What is no UTF-8 is replaced, since the line would be no JSON otherwise.
  EXPECT_THAT(std::get<Miss>(read.detection).detail, HasSubstr("none closed"));
}

TEST(DetectorProtocol, AHelloIsAnsweredOrRefused) {
  EXPECT_EQ(HelloKind(HelloAnswer()), "none");
  EXPECT_EQ(HelloKind(R"({"protocol": 1, "name": "mine"})"), "none");
  EXPECT_EQ(HelloKind(RefusalAnswer("size_m must be positive")), "refused");
  EXPECT_EQ(HelloKind(R"({"protocol": 2})"), "bad_answer");
  EXPECT_EQ(HelloKind(R"({})"), "bad_answer");
  EXPECT_EQ(HelloKind(R"([1])"), "bad_answer");
  EXPECT_EQ(HelloKind(HelloRequest(Command())), "bad_answer");  // As `cat` answers.
  EXPECT_EQ(HelloKind("Loading weights..."), "bad_json");
  EXPECT_EQ(HelloKind(""), "bad_json");
}

TEST(DetectorProtocol, ARefusalSaysWhy) {
  try {
    CheckHelloAnswer(RefusalAnswer("size_m must be positive"));
    FAIL() << "accepted";
  } catch (const DetectorFailure& failure) {
    EXPECT_STREQ(failure.what(), "size_m must be positive");
  }
}

TEST(DetectorProtocol, EachWrongAnswerHasItsKind) {
  EXPECT_EQ(AnswerKind(ErrorAnswer(7, "division by zero")), "exception");
  EXPECT_EQ(AnswerKind(DetectAnswer(8, Window())), "wrong_id");
  EXPECT_EQ(AnswerKind(R"({"outcome": "miss", "reason": "no_contour"})"), "wrong_id");
  EXPECT_EQ(AnswerKind(R"({"id": "7", "outcome": "miss", "reason": "no_contour"})"), "wrong_id");
  EXPECT_EQ(AnswerKind(R"({"id": 7})"), "bad_answer");
  EXPECT_EQ(AnswerKind(R"({"id": 7, "outcome": "perhaps"})"), "bad_answer");
  EXPECT_EQ(AnswerKind(R"({"id": 7, "outcome": "window", "centroid_m": [1, 2]})"), "bad_answer");
  EXPECT_EQ(AnswerKind(R"({"id": 7, "outcome": "miss", "reason": "No contour!"})"), "bad_answer");
  EXPECT_EQ(AnswerKind(R"({"id": 7, "outcome")"), "bad_json");
}

// Objects keep the order of their keys and are searched from end to end.
TEST(DetectorProtocol, ALineOfKeysAloneIsRefused) {
  std::string line = R"({"id": 7)";
  for (int i = 0; i < 6000; ++i) line += ",\"k" + std::to_string(i) + "\": 0";
  EXPECT_EQ(AnswerKind(line + "}"), "bad_answer");
}

TEST(DetectorProtocol, WhatIsNoRequestIsAnError) {
  for (const char* line :
       {"", "hello", "{}", R"({"request": "stop"})", R"({"request": "hello"})",
        R"({"request": "hello", "sensor": "stereo"})", R"({"request": "detect", "id": 1})",
        R"({"request": "detect", "calibration": "c.yaml", "left": "l.png", "right": "r.png"})",
        R"({"request": "detect", "id": 1, "calibration": "c.yaml", "left": "l.png"})"}) {
    EXPECT_THROW(ParseRequest(line), std::runtime_error) << line;
  }
}

}  // namespace
}  // namespace fenestra
