#include "scenes/gltf/reader/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "scenes/gltf/reader/cost.h"
#include "tests/scenes/gltf/gltf_text.h"
#include "tests/support/temporary_folder.h"

namespace fenestra::gltf {
namespace {

using fenestra::testing::AddAccessor;
using fenestra::testing::TemporaryFolder;
using fenestra::testing::TriangleDocument;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Placed {
  PlacedMeshes meshes;
  std::vector<std::string> notes;
};

Placed Place(const json& document, size_t max_triangles = 1000,
             const std::vector<ReadMaterial>& materials = {}) {
  const TemporaryFolder folder;
  const Asset asset = LoadAsset(folder.Write("scene.gltf", document.dump()), {});
  Notes notes;
  const std::vector<PlacedNode> nodes = PlaceNodes(asset, std::nullopt);
  CheckCost(asset, nodes, {.max_triangles = max_triangles});
  Placed placed{PlaceMeshes(asset, nodes, materials, notes), {}};
  placed.notes = notes.Sentences();
  return placed;
}

std::vector<std::string> NamesOf(const Placed& placed) {
  std::vector<std::string> names;
  for (const Mesh& mesh : placed.meshes.meshes) names.push_back(mesh.name);
  return names;
}

std::string RefusalOf(const json& document, size_t max_triangles) {
  try {
    Place(document, max_triangles);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Meshes, StandWhereTheirNodesAre) {
  json document = TriangleDocument();
  document["nodes"] = json::parse(
      R"([{"mesh": 0, "translation": [1, 2, 3], "children": [1]}, {"mesh": 0, "scale": [2, 2, 2]}])");
  const Placed placed = Place(document);
  ASSERT_EQ(placed.meshes.meshes.size(), 2u);
  EXPECT_THAT(placed.meshes.meshes[0].positions_W,
              ElementsAre(glm::vec3(1, 2, 3), glm::vec3(2, 2, 3), glm::vec3(1, 3, 3)));
  EXPECT_THAT(placed.meshes.meshes[1].positions_W,
              ElementsAre(glm::vec3(1, 2, 3), glm::vec3(3, 2, 3), glm::vec3(1, 4, 3)));
  EXPECT_THAT(placed.meshes.first_mesh, ElementsAre(0u, 1u, 2u));
}

TEST(Meshes, AreNamedAfterNodeOrMeshAndNumberedByPartAndInstance) {
  json document = TriangleDocument();
  document["meshes"][0]["name"] = "pane";
  EXPECT_THAT(NamesOf(Place(document)), ElementsAre("pane"));
  document["nodes"][0]["name"] = "window";
  EXPECT_THAT(NamesOf(Place(document)), ElementsAre("window"));
  document["meshes"][0]["primitives"].push_back(document["meshes"][0]["primitives"][0]);
  EXPECT_THAT(NamesOf(Place(document)), ElementsAre("window.0", "window.1"));
  document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  const int places = AddAccessor(document, "VEC3", {0, 0, 0, 5, 0, 0});
  document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      places;
  EXPECT_THAT(NamesOf(Place(document)),
              ElementsAre("window[0].0", "window[0].1", "window[1].0", "window[1].1"));
}

TEST(Meshes, APrimitiveWithoutMaterialHasTheOneBehindTheLast) {
  json document = TriangleDocument();
  document["materials"] = json::parse(R"([{}, {}])");
  document["meshes"][0]["primitives"].push_back(document["meshes"][0]["primitives"][0]);
  document["meshes"][0]["primitives"][1]["material"] = 1;
  const Placed placed = Place(document, 1000, std::vector<ReadMaterial>(2));
  EXPECT_EQ(placed.meshes.meshes.at(0).material, 2u);
  EXPECT_EQ(placed.meshes.meshes.at(1).material, 1u);
}

TEST(Meshes, WhatIsInvisibleIsLeftOut) {
  json document = TriangleDocument();
  document["materials"] = json::parse(R"([{}])");
  document["meshes"][0]["primitives"][0]["material"] = 0;
  std::vector<ReadMaterial> materials(1);
  EXPECT_EQ(Place(document, 1000, materials).meshes.meshes.size(), 1u);
  materials[0].is_invisible = true;
  EXPECT_THAT(Place(document, 1000, materials).meshes.meshes, IsEmpty());
  document = TriangleDocument();
  document["extensionsUsed"] = {"KHR_node_visibility"};
  document["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
  EXPECT_THAT(Place(document).meshes.meshes, IsEmpty());
}

TEST(Meshes, OurExtrasSayWhichAreClosed) {
  json document = TriangleDocument();
  EXPECT_FALSE(Place(document).meshes.meshes.at(0).closed);
  document["meshes"][0]["extras"]["fenestra"]["closed"] = true;
  EXPECT_TRUE(Place(document).meshes.meshes.at(0).closed);
}

TEST(Meshes, PointsAndLinesAreNotedAndLeftOut) {
  json document = TriangleDocument();
  document["meshes"][0]["name"] = "wires";
  document["meshes"][0]["primitives"][0]["mode"] = 1;
  document["meshes"][0]["primitives"][0].erase("indices");
  const Placed placed = Place(document);
  EXPECT_THAT(placed.meshes.meshes, IsEmpty());
  EXPECT_THAT(placed.notes, ElementsAre(HasSubstr("mesh 'wires'")));
}

TEST(Meshes, TrianglesAreCountedBeforeTheyAreRead) {
  json document = TriangleDocument();
  for (int i = 0; i < 9; ++i) {
    document["nodes"].push_back({{"mesh", 0}});
    document["scenes"][0]["nodes"].push_back(i + 1);
  }
  EXPECT_EQ(RefusalOf(document, 10), "");
  EXPECT_THAT(RefusalOf(document, 9), HasSubstr("more than 9 triangles"));
  // What is not visible costs nothing.
  document["extensionsUsed"] = {"KHR_node_visibility"};
  document["nodes"][3]["extensions"]["KHR_node_visibility"]["visible"] = false;
  EXPECT_EQ(RefusalOf(document, 9), "");
}

}  // namespace
}  // namespace fenestra::gltf
