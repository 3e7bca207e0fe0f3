#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/scenes/gltf/gltf_text.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::ReadDocument;
using testing::TriangleDocument;

// A few products of doubles of order one.
constexpr double kTolerance = 1e-14;

TEST(GltfNodes, TransformsAreComposedFromTheRootDown) {
  json document = TriangleDocument();
  const double half = std::sqrt(0.5);
  document["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                       {{"mesh", 0}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, 1}}}};
  const auto p = ReadDocument(document).scene.meshes.at(0).positions_W;
  // (1, 0, 0) is scaled, turned a quarter about z, moved; single precision of 10.
  EXPECT_LT(glm::distance(p[1], glm::vec3(10, 2, 0)), 1e-6f);
  EXPECT_LT(glm::distance(p[2], glm::vec3(7, 0, 0)), 1e-6f);
}

// Outward is outward still, by winding and by normals, and the normals stay perpendicular.
TEST(GltfNodes, AMirroredAndUnevenlyScaledBodyKeepsItsOutside) {
  const auto box = testing::GltfData() / "samples/Box/glTF-Embedded/Box.gltf";
  std::ifstream stream(box);
  json document = json::parse(stream);
  document["nodes"][1].erase("matrix");
  document["nodes"][1]["scale"] = {-2, 3, 0.5};
  document["nodes"][1]["rotation"] = {0.36, 0.48, 0.0, 0.8};
  const Mesh mesh = ReadDocument(document).scene.meshes.at(0);
  EXPECT_NEAR(testing::SignedVolume(mesh), 3.0, 1e-5);  // Single precision.
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions_W[t.x];
    const glm::vec3 n =
        glm::normalize(glm::cross(mesh.positions_W[t.y] - a, mesh.positions_W[t.z] - a));
    EXPECT_GT(glm::dot(n, mesh.normals_W[t.x]), 1.0f - 1e-5f);
  }
}

TEST(GltfNodes, HiddenSubtreesAreLeftOut) {
  json document = TriangleDocument();
  document["extensionsUsed"] = {"KHR_node_visibility"};
  document["nodes"] = {
      {{"children", {1}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
      {{"mesh", 0}}};
  EXPECT_TRUE(ReadDocument(document).scene.meshes.empty());
}

// Bound at (1, 0, 0) and turned by a quarter about z since: what was one to its right is now one
// above the joint, which stands at (5, 0, 0). The skinned node's own place does not count.
TEST(GltfSkins, VerticesMoveWithTheirJointFromWhereItWasBound) {
  json document = TriangleDocument();
  const double half = std::sqrt(0.5);
  auto& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  document["buffers"][0]["uri"] = testing::DataUriOf<float>({2, 0, 0, 1, 0, 0, 1, 1, 0});
  document["buffers"].push_back(
      {{"byteLength", 12}, {"uri", testing::DataUri(std::vector<uint8_t>(12, 0))}});
  document["bufferViews"].push_back({{"buffer", 2}, {"byteLength", 12}});
  document["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5121}, {"count", 3}, {"type", "VEC4"}});
  attributes["JOINTS_0"] = 2;
  attributes["WEIGHTS_0"] =
      testing::AddAccessor(document, "VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  const int bind =
      testing::AddAccessor(document, "MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
  document["skins"] = {{{"joints", {1}}, {"inverseBindMatrices", bind}}};
  document["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 100, 100}}},
                       {{"translation", {5, 0, 0}}, {"rotation", {0, 0, half, half}}}};
  document["scenes"][0]["nodes"] = {0, 1};
  const auto p = ReadDocument(document).scene.meshes.at(0).positions_W;
  constexpr float kSinglePrecision = 1e-6f;  // Of coordinates of about 5.
  EXPECT_LT(glm::distance(p[0], glm::vec3(5, 1, 0)), kSinglePrecision);
  EXPECT_LT(glm::distance(p[1], glm::vec3(5, 0, 0)), kSinglePrecision);
  EXPECT_LT(glm::distance(p[2], glm::vec3(4, 0, 0)), kSinglePrecision);
}

TEST(GltfCameras, AFieldOfViewBecomesACentredPinhole) {
  json document = TriangleDocument();
  document["cameras"] = {
      {{"type", "perspective"},
       {"perspective", {{"yfov", 0.5 * std::numbers::pi}, {"aspectRatio", 2.0}, {"znear", 0.1}}}}};
  document["nodes"][0] = {{"name", "eye"}, {"camera", 0}, {"translation", {0, 0, 5}}};
  const auto cameras = ReadDocument(document, {.camera_height_px = 100}).cameras;
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras[0].name, "eye");
  const CameraParameters& p = cameras[0].model.parameters();
  EXPECT_EQ(p.width_px, 200);
  EXPECT_EQ(p.height_px, 100);
  EXPECT_NEAR(p.fx_px, 50.0, 50.0 * kTolerance);  // 45° up reach half of the height.
  EXPECT_EQ(p.cx_px, 99.5);
  // It looks along the world's -z, and what is higher in the world is higher in the image.
  const Vector3d p_CQ = cameras[0].X_WC.inverse() * Vector3d(0.0, 1.0, 0.0);
  EXPECT_EQ(p_CQ, Vector3d(0.0, -1.0, 5.0));
}

TEST(GltfCameras, WhatIsNoPinholeIsLeftOutWithANote) {
  json document = TriangleDocument();
  document["cameras"] = json::parse(R"([
    {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 9, "znear": 0}},
    {"type": "perspective", "perspective": {"yfov": 4, "znear": 0.1}}])");
  document["nodes"] = json::parse(R"([{"camera": 0}, {"camera": 1}])");
  document["scenes"][0]["nodes"] = {0, 1};
  document.erase("meshes");
  const GltfScene gltf = ReadDocument(document);
  EXPECT_TRUE(gltf.cameras.empty());
  EXPECT_THAT(gltf.notes,
              ElementsAre(HasSubstr("camera 0: an orthographic"),
                          HasSubstr("camera 1: a field of view"), HasSubstr("nothing to see")));
}

json WithLights(const char* lights, int count) {
  json document = TriangleDocument();
  document["extensionsUsed"] = {"KHR_lights_punctual"};
  document["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(lights);
  for (int i = 0; i < count; ++i) {
    document["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    document["scenes"][0]["nodes"].push_back(i + 1);
  }
  return document;
}

TEST(GltfLights, TheSunStandsWhereItsLightComesFrom) {
  json document = WithLights(R"([{"type": "directional", "intensity": 50000}])", 1);
  // Light along the node's -z: unturned it comes from +z; tilted up by 30° about x, from above.
  document["nodes"][1]["rotation"] = {-std::sin(std::numbers::pi / 12.0), 0, 0,
                                      std::cos(std::numbers::pi / 12.0)};
  const auto sun = ReadDocument(document).sun;
  ASSERT_TRUE(sun);
  EXPECT_NEAR(sun->azimuth_rad, 0.0, kTolerance);
  EXPECT_NEAR(sun->elevation_rad, std::numbers::pi / 6.0, kTolerance);
  EXPECT_NEAR(sun->illuminance_lx, 50000.0, 50000.0 * kTolerance);
}

TEST(GltfLights, OneSunIsEnough) {
  const GltfScene gltf = ReadDocument(
      WithLights(R"([{"type": "directional"}, {"type": "directional", "intensity": 7}])", 2));
  EXPECT_NEAR(gltf.sun.value().illuminance_lx, 1.0, kTolerance);
  EXPECT_THAT(gltf.notes, ElementsAre(HasSubstr("light 1: a second directional")));
}

TEST(GltfLights, PointsAndSpotsBecomeLamps) {
  json document = WithLights(R"([
    {"type": "point", "color": [1, 0.5, 0], "intensity": 200, "range": 3},
    {"type": "spot", "intensity": 10, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}}])",
                             2);
  document["nodes"][1]["translation"] = {1, 2, 3};
  const GltfScene gltf = ReadDocument(document);
  ASSERT_EQ(gltf.scene.lamps.size(), 2u);
  EXPECT_EQ(gltf.scene.lamps[0].intensity_rgb, glm::vec3(200, 100, 0));
  EXPECT_EQ(gltf.scene.lamps[0].p_WL, Vector3d(1, 2, 3));
  EXPECT_FALSE(gltf.scene.lamps[0].cone);
  ASSERT_TRUE(gltf.scene.lamps[1].cone);
  EXPECT_EQ(gltf.scene.lamps[1].cone->axis_W, Vector3d(0, 0, -1));
  EXPECT_EQ(gltf.scene.lamps[1].cone->inner_rad, 0.1);
  EXPECT_EQ(gltf.scene.lamps[1].cone->outer_rad, 0.2);
  EXPECT_THAT(gltf.notes, ElementsAre(HasSubstr("no range")));
}

TEST(GltfSurfaces, QuantizedPositionsNeedTheirExtension) {
  json document = TriangleDocument();
  document["buffers"][0] = {
      {"byteLength", 24},
      {"uri", testing::DataUriOf<int16_t>({0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0})}};
  document["bufferViews"][0] = {{"buffer", 0}, {"byteLength", 24}, {"byteStride", 8}};
  document["accessors"][0]["componentType"] = 5122;
  document["accessors"][0]["normalized"] = true;
  EXPECT_THAT(testing::Refusal(document),
              HasSubstr("attributes/POSITION: /accessors/0 has a type"));
  document["extensionsUsed"] = {"KHR_mesh_quantization"};
  document["extensionsRequired"] = {"KHR_mesh_quantization"};
  const auto p = ReadDocument(document).scene.meshes.at(0).positions_W;
  EXPECT_EQ(p[1], glm::vec3(1, 0, 0));
  EXPECT_EQ(p[2], glm::vec3(0, -1, 0));  // -32768 / 32767 is clamped.
}

TEST(GltfSurfaces, NormalsAreNormalisedAndThoseWithoutDirectionDropped) {
  json document = TriangleDocument();
  auto& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = testing::AddAccessor(document, "VEC3", {0, 0, 2, 0, 3, 0, 1, 0, 0});
  EXPECT_THAT(ReadDocument(document).scene.meshes.at(0).normals_W,
              ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), glm::vec3(1, 0, 0)));
  attributes["NORMAL"] = testing::AddAccessor(document, "VEC3", {0, 0, 2, 0, 0, 0, 1, 0, 0});
  const GltfScene gltf = ReadDocument(document);
  EXPECT_TRUE(gltf.scene.meshes.at(0).normals_W.empty());
  EXPECT_THAT(gltf.notes, ElementsAre(HasSubstr("no direction")));
}

}  // namespace
}  // namespace fenestra
