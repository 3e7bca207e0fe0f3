#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "core/detection/detection_json.h"

namespace fenestra {
namespace {

using nlohmann::ordered_json;
using ::testing::HasSubstr;

// A window 1 m wide and 2 m before the camera, facing it.
ordered_json WindowJson() {
  return ordered_json::parse(R"({"outcome": "window", "centroid_m": [0, 0, 2],
    "corners_m": [[-0.5, -0.5, 2], [0.5, -0.5, 2], [0.5, 0.5, 2], [-0.5, 0.5, 2]]})");
}

ordered_json MissOf(const std::string& reason) {
  return {{"outcome", "miss"}, {"reason", reason}, {"detail", "why"}};
}

std::string ComplaintOf(const ordered_json& json) {
  try {
    DetectionFromJson(json);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string ComplaintWith(const std::string& key, const ordered_json& value) {
  ordered_json json = WindowJson();
  json[key] = value;
  return ComplaintOf(json);
}

TEST(DetectionJsonReader, WhatIsWrittenIsReadToTheBit) {
  WindowEstimate estimate;
  estimate.p_CO = {1.0 / 3.0, -0.0, 5e-324};
  estimate.p_CV = {Eigen::Vector3d(0.1, 0.2, 0.3), Eigen::Vector3d(1.0 / 7.0, 0, 1),
                   Eigen::Vector3d(1e300, 0, 1), Eigen::Vector3d(0, 1, 1)};
  estimate.normal_C = Eigen::Vector3d(1, 2, -3).normalized();
  estimate.covariance_C = Eigen::Matrix3d::Constant(1.0 / 3e7);
  estimate.score = 0.1;
  WindowEstimate other = estimate;
  other.p_CO.x() = 7.0;
  estimate.others = {other};
  const TimedDetection read = DetectionFromJson(ToJson(estimate, {{"fit", 1.0 / 3.0}}));
  const auto& back = std::get<WindowEstimate>(read.detection);
  EXPECT_EQ(back.p_CO, estimate.p_CO);
  EXPECT_TRUE(std::signbit(back.p_CO.y()));
  EXPECT_EQ(back.p_CV, estimate.p_CV);
  EXPECT_EQ(back.normal_C, estimate.normal_C);
  EXPECT_EQ(*back.covariance_C, *estimate.covariance_C);
  EXPECT_EQ(back.score, estimate.score);
  ASSERT_EQ(back.others.size(), 1u);
  EXPECT_EQ(back.others[0].p_CO.x(), 7.0);
  ASSERT_EQ(read.stages.size(), 1u);
  EXPECT_EQ(read.stages[0].seconds, 1.0 / 3.0);
}

TEST(DetectionJsonReader, AMissIsReadWithItsReason) {
  const Miss miss = std::get<Miss>(DetectionFromJson(MissOf("no_contour")).detection);
  EXPECT_EQ(miss.reason, "no_contour");
  EXPECT_EQ(miss.detail, "why");
  ordered_json bare = MissOf("no_contour");
  bare.erase("detail");
  EXPECT_EQ(std::get<Miss>(DetectionFromJson(bare).detection).detail, "");
}

// The corners go clockwise as seen, so the normal comes towards the camera.
TEST(DetectionJsonReader, AMissingNormalIsThatOfTheCorners) {
  const auto window = std::get<WindowEstimate>(DetectionFromJson(WindowJson()).detection);
  EXPECT_EQ(window.normal_C, -Eigen::Vector3d::UnitZ());
  ordered_json reversed = WindowJson();
  std::reverse(reversed["corners_m"].begin(), reversed["corners_m"].end());
  EXPECT_EQ(std::get<WindowEstimate>(DetectionFromJson(reversed).detection).normal_C,
            -Eigen::Vector3d::UnitZ());
  ordered_json flat = WindowJson();
  for (ordered_json& corner : flat["corners_m"]) corner[1] = 0.0;
  EXPECT_THAT(ComplaintOf(flat), HasSubstr("the corners span no plane"));
}

TEST(DetectionJsonReader, OtherKeysAreIgnored) {
  EXPECT_EQ(ComplaintWith("size_m", "large"), "");
  EXPECT_EQ(ComplaintWith("mine", {1, 2, 3}), "");
}

TEST(DetectionJsonReader, WhatIsMissingIsNamed) {
  for (const char* key : {"outcome", "centroid_m", "corners_m"}) {
    ordered_json json = WindowJson();
    json.erase(key);
    EXPECT_THAT(ComplaintOf(json), HasSubstr(std::string("'") + key + "' is missing"));
  }
  EXPECT_THAT(ComplaintOf({{"outcome", "miss"}}), HasSubstr("'reason' is missing"));
}

TEST(DetectionJsonReader, WrongShapesAreRefused) {
  EXPECT_THAT(ComplaintOf(ordered_json::array()), HasSubstr("must be an object"));
  EXPECT_THAT(ComplaintWith("outcome", "perhaps"), HasSubstr("\"window\" or \"miss\""));
  EXPECT_THAT(ComplaintWith("outcome", 3), HasSubstr("'outcome' must be text"));
  EXPECT_THAT(ComplaintWith("centroid_m", {1, 2}), HasSubstr("must be three numbers"));
  EXPECT_THAT(ComplaintWith("centroid_m", {1, 2, "3"}), HasSubstr("must be a number"));
  EXPECT_THAT(ComplaintWith("centroid_m", {1, 2, nullptr}), HasSubstr("must be a number"));
  EXPECT_THAT(ComplaintWith("corners_m", {{1, 2, 3}}), HasSubstr("must be four points"));
  EXPECT_THAT(ComplaintWith("centroid_covariance_m2", {1, 2, 3}), HasSubstr("a row of"));
  EXPECT_THAT(ComplaintWith("score", "high"), HasSubstr("'score' must be a number"));
  EXPECT_THAT(ComplaintWith("others", {1}), HasSubstr("a window must be an object"));
  EXPECT_THAT(ComplaintWith("stage_seconds", {1}), HasSubstr("must be an object"));
}

TEST(DetectionJsonReader, ReasonsAreIdentifiers) {
  EXPECT_EQ(ComplaintOf(MissOf("a_1")), "");
  for (const std::string& reason :
       {std::string(), std::string("No contour"), std::string("näher"), std::string(65, 'a')}) {
    EXPECT_THAT(ComplaintOf(MissOf(reason)), HasSubstr("'reason' must be 1 to 64")) << reason;
  }
}

TEST(DetectionJsonReader, TimesAreNotNegative) {
  EXPECT_EQ(ComplaintWith("stage_seconds", {{"fit", 0.0}}), "");
  EXPECT_THAT(ComplaintWith("stage_seconds", {{"fit", -0.1}}), HasSubstr("is negative"));
  EXPECT_THAT(ComplaintWith("stage_seconds", {{"", 0.1}}), HasSubstr("must have 1 to 64 bytes"));
}

// What a program sends costs no more than a list of bounded length.
TEST(DetectionJsonReader, ListsAreBounded) {
  ordered_json others = ordered_json::array();
  for (int i = 0; i < 1001; ++i) others.push_back(WindowJson());
  EXPECT_THAT(ComplaintWith("others", others), HasSubstr("at most 1000 windows"));
  ordered_json stages = ordered_json::object();
  for (int i = 0; i < 101; ++i) stages["s" + std::to_string(i)] = 0.0;
  EXPECT_THAT(ComplaintWith("stage_seconds", stages), HasSubstr("at most 100 times"));
  ordered_json miss = MissOf("no_contour");
  miss["detail"] = std::string(5000, 'x');
  EXPECT_EQ(std::get<Miss>(DetectionFromJson(miss).detection).detail.size(), 2000u);
}

}  // namespace
}  // namespace fenestra
