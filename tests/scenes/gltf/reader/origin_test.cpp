#include "scenes/gltf/reader/origin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/scenes/gltf/gltf_text.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::ReadDocument;
using testing::TriangleDocument;

struct Place {
  std::vector<double> translation;
  double turned_deg;
};

// A triangle, a camera, a lamp and a window, all below one root node.
json HouseAt(const Place& place) {
  json document = TriangleDocument();
  document["extensionsUsed"] = {"KHR_lights_punctual"};
  document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  document["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
  const double half_rad = 0.5 * place.turned_deg * kDegree;
  document["nodes"] = {
      {{"translation", place.translation},
       {"rotation", {0.0, std::sin(half_rad), 0.0, std::cos(half_rad)}},
       {"children", {1, 2, 3, 4}}},
      {{"mesh", 0}, {"translation", {0.3, 0.7, -0.9}}},
      {{"camera", 0}, {"translation", {0.1, 0.2, 3.3}}},
      {{"translation", {0.4, 1.9, 0.6}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
      {{"translation", {0.2, -0.1, 0.01}},
       {"extras", {{"fenestra", {{"target_window", {{"width_m", 1.0}, {"height_m", 1.0}}}}}}}}};
  return document;
}

Vector3d ToEigen(const glm::vec3& p) {
  return {p.x, p.y, p.z};
}

// UTM with y as height, the Swiss grid, a map's projection, and one that is just beyond the limit.
const std::vector<Place> kFarPlaces = {{{500000.25, 0.0, -4649776.5}, 90.0},
                                       {{2600000.0, 450.0, -1200000.0}, 45.0},
                                       {{3904000.0, 0.0, 1120000.0}, 0.0},
                                       {{101.0, 0.0, 0.0}, 10.0}};

TEST(GltfOrigin, AFarSceneIsTheNearOneSeenFromItsCamera) {
  const GltfScene near = ReadDocument(HouseAt({{0.0, 0.0, 0.0}, 0.0}));
  EXPECT_EQ(near.p_FW, Vector3d::Zero());
  EXPECT_THAT(near.notes, IsEmpty());
  for (const Place& place : kFarPlaces) {
    const GltfScene far = ReadDocument(HouseAt(place));
    // Doubles at 5e6 are 1e-9 apart; a float of a few metres is 2e-7.
    constexpr double kTruthTolerance_m = 1e-8;
    constexpr double kSurfaceTolerance_m = 1e-6;
    const Pose X_NF = near.cameras[0].X_WC * far.cameras[0].X_WC.inverse();
    EXPECT_LT((X_NF * far.scene.target->Centroid_W() - near.scene.target->Centroid_W()).norm(),
              kTruthTolerance_m);
    EXPECT_LT((X_NF * far.scene.lamps[0].p_WL - near.scene.lamps[0].p_WL).norm(),
              kTruthTolerance_m);
    for (size_t i = 0; i < 3; ++i) {
      const Vector3d p_far = X_NF * ToEigen(far.scene.meshes[0].positions_W[i]);
      EXPECT_LT((p_far - ToEigen(near.scene.meshes[0].positions_W[i])).norm(), kSurfaceTolerance_m);
    }
  }
}

TEST(GltfOrigin, TheOriginAndThePoseMakeTheFilesOwnCoordinates) {
  for (const Place& place : kFarPlaces) {
    const GltfScene far = ReadDocument(HouseAt(place));
    EXPECT_EQ(far.p_FW, Vector3d(far.p_FW.array().round()));
    const double a = place.turned_deg * kDegree;
    const Vector3d p_FC =
        Vector3d(place.translation[0], place.translation[1], place.translation[2]) +
        Vector3d(std::cos(a) * 0.1 + std::sin(a) * 3.3, 0.2,
                 -std::sin(a) * 0.1 + std::cos(a) * 3.3);
    EXPECT_LT((far.p_FW + far.cameras[0].X_WC.translation() - p_FC).norm(), 1e-8);
    EXPECT_LT(far.scene.target->Centroid_W().cwiseAbs().maxCoeff(), 1.5);
    EXPECT_THAT(far.notes, Contains(HasSubstr("all poses are given from (")));
  }
}

// Coordinates of a map inside the vertices cannot be mended, and a node that takes them back
// brings the scene to its origin.
TEST(GltfOrigin, WhatTheFileHasInSinglePrecisionIsSaid) {
  json document = TriangleDocument();
  document["buffers"][0]["uri"] =
      testing::DataUriOf<float>({4649776, 0, 0, 4649777, 0, 0, 4649776, 1, 0});
  GltfScene scene = ReadDocument(document);
  EXPECT_EQ(scene.p_FW, Vector3d(4649777.0, 1.0, 0.0));  // Halves are rounded away from zero.
  EXPECT_THAT(scene.notes, Contains(HasSubstr("knows it to 0.6 m only")));
  EXPECT_EQ(scene.scene.meshes[0].positions_W[1], glm::vec3(0, -1, 0));
  document["nodes"][0]["translation"] = {-4649776, 0, 0};
  scene = ReadDocument(document);
  EXPECT_EQ(scene.p_FW, Vector3d::Zero());
  EXPECT_THAT(scene.notes, Contains(HasSubstr("knows it to 0.6 m only")));
  document["nodes"][0]["scale"] = {1e-4, 1e-4, 1e-4};
  EXPECT_THAT(ReadDocument(document).notes, Not(Contains(HasSubstr("m only"))));
}

TEST(GltfOrigin, AStrayBodyDoesNotDrawTheOriginAway) {
  json document = TriangleDocument();
  document["nodes"] = {{{"mesh", 0}, {"translation", {4e6, 0, 0}}},
                       {{"mesh", 0}, {"translation", {4e6, 0, 1}}},
                       {{"mesh", 0}, {"name", "north arrow"}}};
  document["scenes"][0]["nodes"] = {0, 1, 2};
  const GltfScene scene = ReadDocument(document);
  EXPECT_NEAR(scene.p_FW.x(), 4e6, 2.0);
  EXPECT_THAT(scene.notes, Contains(HasSubstr("mesh 'north arrow': it reaches so far")));
}

TEST(GltfOrigin, InstancesAndSkinsMoveWithTheScene) {
  const double half = std::sqrt(0.5);
  const auto document_at = [half](double x) {
    json document = TriangleDocument();
    document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const int places = testing::AddAccessor(document, "VEC3", {1, 0, 0, 0, 2, 0});
    auto& attributes =
        document["meshes"].emplace_back(document["meshes"][0])["primitives"][0]["attributes"];
    document["buffers"].push_back(
        {{"byteLength", 12}, {"uri", testing::DataUri(std::vector<uint8_t>(12, 0))}});
    document["bufferViews"].push_back(
        {{"buffer", document["buffers"].size() - 1}, {"byteLength", 12}});
    attributes["JOINTS_0"] = document["accessors"].size();
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", 5121},
                                     {"count", 3},
                                     {"type", "VEC4"}});
    attributes["WEIGHTS_0"] =
        testing::AddAccessor(document, "VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    document["skins"] = {{{"joints", {2}}}};
    document["nodes"] = {
        {{"translation", {x, 0.0, 2.0 * x}},
         {"rotation", {0.0, half, 0.0, half}},
         {"children", {1, 2}}},
        {{"mesh", 0},
         {"extensions",
          {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}},
        {{"translation", {0.5, 0.25, 0.125}}},
        {{"mesh", 1}, {"skin", 0}}};
    document["scenes"][0]["nodes"] = {0, 3};
    return document;
  };
  const GltfScene near = ReadDocument(document_at(0.0));
  const GltfScene far = ReadDocument(document_at(3e6));
  ASSERT_EQ(near.scene.meshes.size(), 3u);
  ASSERT_EQ(far.scene.meshes.size(), 3u);
  const Vector3d p_FN(3e6, 0.0, 6e6);
  for (size_t m = 0; m < 3; ++m) {
    for (size_t i = 0; i < 3; ++i) {
      const Vector3d p_F = far.p_FW + ToEigen(far.scene.meshes[m].positions_W[i]);
      EXPECT_LT((p_F - p_FN - ToEigen(near.scene.meshes[m].positions_W[i])).norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace fenestra
