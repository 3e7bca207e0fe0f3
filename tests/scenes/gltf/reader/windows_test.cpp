#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/scenes/gltf/gltf_text.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using ::testing::HasSubstr;
using testing::ReadDocument;
using testing::Refusal;
using testing::TriangleDocument;

// A product or two of doubles of order one.
constexpr double kWindowTolerance = 1e-14;

json WithWindow(const char* role, double width_m, double height_m) {
  json document = TriangleDocument();
  document["nodes"][0]["name"] = "frame";
  document["nodes"][0]["extras"]["fenestra"][role] = {{"width_m", width_m}, {"height_m", height_m}};
  return document;
}

TEST(GltfWindows, ExtrasMarkTheTargetInItsNodesFrame) {
  json document = WithWindow("target_window", 1.2, 0.9);
  document["nodes"][0]["translation"] = {1, 2, 3};
  const double half = std::sqrt(0.5);
  document["nodes"][0]["rotation"] = {0, half, 0, half};  // A quarter turn about y.
  const auto target = ReadDocument(document).scene.target;
  ASSERT_TRUE(target);
  EXPECT_EQ(target->width_m, 1.2);
  EXPECT_EQ(target->height_m, 0.9);
  EXPECT_EQ(target->Centroid_W(), Vector3d(1, 2, 3));
  const Vector3d normal_W = target->X_WO.rotation().col(2);
  EXPECT_LT((normal_W - Vector3d::UnitX()).norm(), kWindowTolerance);
}

TEST(GltfWindows, ScaleMultipliesTheSizesThroughAllAncestors) {
  json document = WithWindow("target_window", 1.0, 0.5);
  document["nodes"][0]["scale"] = {2, 3, 7};
  document["nodes"].push_back({{"children", {0}}, {"scale", {10, 10, 10}}});
  document["scenes"][0]["nodes"] = {1};
  const auto target = ReadDocument(document).scene.target;
  ASSERT_TRUE(target);
  EXPECT_NEAR(target->width_m, 20.0, 20.0 * kWindowTolerance);
  EXPECT_NEAR(target->height_m, 15.0, 15.0 * kWindowTolerance);
  EXPECT_LT((target->X_WO.rotation() - Eigen::Matrix3d::Identity()).norm(), kWindowTolerance);
}

TEST(GltfWindows, ShearedAndMirroredOnesAreRefused) {
  json document = WithWindow("target_window", 1.0, 1.0);
  document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0.1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_THAT(Refusal(document), HasSubstr("/nodes/0: a window must not be sheared"));
  document["nodes"][0]["matrix"] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_THAT(Refusal(document), HasSubstr("/nodes/0: a window must not be sheared"));
  document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(Refusal(document), "");
}

// The triangle spans 1 by 1 at z = 0; below, a second one half as large lies further in front.
TEST(GltfWindows, ANamedNodesBoundingBoxGivesTheRectangle) {
  json document = TriangleDocument();
  document["nodes"] = json::parse(R"([
    {"name": "wall", "mesh": 0, "scale": [50, 50, 1]},
    {"name": "frame", "translation": [10, 20, 30], "scale": [2, 2, 2], "children": [2, 3]},
    {"mesh": 0},
    {"name": "sill", "mesh": 0, "translation": [0, -1, 0.25]}])");
  document["scenes"][0]["nodes"] = {0, 1};
  const auto target = ReadDocument(document, {.target_node = "frame"}).scene.target;
  ASSERT_TRUE(target);
  EXPECT_NEAR(target->width_m, 2.0, kWindowTolerance);
  EXPECT_NEAR(target->height_m, 4.0, kWindowTolerance);
  EXPECT_LT((target->Centroid_W() - Vector3d(11.0, 20.0, 30.5)).norm(), 100 * kWindowTolerance);
}

TEST(GltfWindows, ANamedTargetMakesTheMarkedOneAnother) {
  json document = WithWindow("target_window", 1.2, 0.9);
  document["nodes"].push_back({{"name", "second"}, {"mesh", 0}});
  document["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = ReadDocument(document, {.target_node = "second"}).scene;
  ASSERT_TRUE(scene.target);
  EXPECT_EQ(scene.target->width_m, 1.0);
  ASSERT_EQ(scene.other_windows.size(), 1u);
  EXPECT_EQ(scene.other_windows[0].width_m, 1.2);
  EXPECT_EQ(ReadDocument(document, {.target_node = "frame"}).scene.target->width_m, 1.2);
}

TEST(GltfWindows, OtherWindowsAreKeptApart) {
  const Scene scene = ReadDocument(WithWindow("other_window", 0.4, 0.3)).scene;
  EXPECT_FALSE(scene.target);
  ASSERT_EQ(scene.other_windows.size(), 1u);
  EXPECT_EQ(scene.other_windows[0].height_m, 0.3);
}

TEST(GltfWindows, NamesThatAreWrongOrNotUniqueAreRefused) {
  json document = WithWindow("target_window", 1.0, 1.0);
  EXPECT_THAT(Refusal(document, {.target_node = "fraem"}), HasSubstr("Did you mean 'frame'?"));
  document["nodes"].push_back(document["nodes"][0]);
  document["scenes"][0]["nodes"] = {0, 1};
  EXPECT_THAT(Refusal(document, {.target_node = "frame"}), HasSubstr("2 nodes are called 'frame'"));
  EXPECT_THAT(Refusal(document), HasSubstr("there is a target already"));
}

TEST(GltfWindows, ANodeWithoutTrianglesIsNoWindow) {
  json document = TriangleDocument();
  document["nodes"].push_back({{"name", "empty"}});
  document["scenes"][0]["nodes"] = {0, 1};
  EXPECT_THAT(Refusal(document, {.target_node = "empty"}), HasSubstr("has no triangles"));
}

}  // namespace
}  // namespace fenestra
