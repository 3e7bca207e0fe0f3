#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/gltf/validation/structure_check.h"
#include "tests/scenes/gltf/gltf_text.h"

// What section 3.7.2 of the specification asks of meshes, each rule broken once.

namespace fenestra::gltf {
namespace {

using fenestra::testing::AddAccessor;
using fenestra::testing::DataUriOf;
using fenestra::testing::Refusal;
using fenestra::testing::TriangleDocument;
using nlohmann::json;
using ::testing::HasSubstr;

json& Attributes(json& document) {
  return document["meshes"][0]["primitives"][0]["attributes"];
}

// An accessor over zeros of this kind, three elements long.
int AddZeros(json& document, int component_type, const std::string& type, size_t element_bytes,
             bool normalized = false) {
  const size_t bytes = 3 * element_bytes;
  document["buffers"].push_back(
      {{"byteLength", bytes}, {"uri", DataUriOf(std::vector<uint8_t>(bytes, 0))}});
  document["bufferViews"].push_back(
      {{"buffer", document["buffers"].size() - 1}, {"byteLength", bytes}});
  document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                   {"componentType", component_type},
                                   {"count", 3},
                                   {"type", type},
                                   {"normalized", normalized}});
  return static_cast<int>(document["accessors"].size()) - 1;
}

TEST(MeshCheck, AttributesOfEveryKindPassInTheirFormats) {
  json document = TriangleDocument();
  Attributes(document)["NORMAL"] = AddAccessor(document, "VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  Attributes(document)["TEXCOORD_0"] = AddAccessor(document, "VEC2", std::vector<float>(6, 0.0f));
  Attributes(document)["TEXCOORD_1"] = AddZeros(document, 5121, "VEC2", 2, true);
  Attributes(document)["COLOR_0"] = AddZeros(document, 5121, "VEC4", 4, true);
  Attributes(document)["_MINE"] = AddZeros(document, 5123, "VEC2", 4);
  // Two bytes a vertex are less than the four that vertices are aligned to.
  EXPECT_THAT(Refusal(document), HasSubstr("must begin at multiples of 4 bytes"));
  Attributes(document).erase("TEXCOORD_1");
  EXPECT_EQ(Refusal(document), "");
}

TEST(MeshCheck, FormatsOfOtherAttributesAreRefused) {
  for (const char* name : {"NORMAL", "TEXCOORD_0", "COLOR_0", "JOINTS_0"}) {
    json document = TriangleDocument();
    Attributes(document)[name] = AddAccessor(document, "SCALAR", {0, 0, 0});
    EXPECT_THAT(Refusal(document), HasSubstr(std::string("/attributes/") + name +
                                             ": /accessors/2 "
                                             "has a type that is not allowed for it"));
  }
}

TEST(MeshCheck, IntegersArePositionsOnlyWhereTheExtensionIsDeclared) {
  json document = TriangleDocument();
  Attributes(document)["POSITION"] = AddZeros(document, 5122, "VEC3", 8);
  document["accessors"][2]["min"] = {0, 0, 0};
  document["accessors"][2]["max"] = {0, 0, 0};
  document["bufferViews"][2]["byteStride"] = 8;
  EXPECT_THAT(Refusal(document), HasSubstr("has a type that is not allowed for it"));
  document["extensionsUsed"] = {"KHR_mesh_quantization"};
  EXPECT_EQ(Refusal(document), "");
}

TEST(MeshCheck, NamesAreThoseOfTheSpecificationOrBeginWithAnUnderscore) {
  for (const char* name : {"POSITIONS", "NORMAL_0", "TEXCOORD", "TEXCOORD_x", "COLOUR_0"}) {
    json document = TriangleDocument();
    Attributes(document)[name] = AddAccessor(document, "VEC2", std::vector<float>(6, 0.0f));
    EXPECT_THAT(Refusal(document), HasSubstr("is not an attribute of glTF 2.0")) << name;
  }
}

TEST(MeshCheck, AttributesAreEquallyLong) {
  json document = TriangleDocument();
  Attributes(document)["TEXCOORD_0"] = AddAccessor(document, "VEC2", std::vector<float>(8, 0.0f));
  EXPECT_THAT(Refusal(document), HasSubstr("elements, while another attribute has"));
}

TEST(MeshCheck, PositionsHaveBounds) {
  json document = TriangleDocument();
  document["accessors"][0].erase("min");
  EXPECT_THAT(Refusal(document), HasSubstr("/accessors/0 must have 'min' and 'max'"));
}

TEST(MeshCheck, IndicesAreUnsignedScalarsSideBySide) {
  json document = TriangleDocument();
  document["accessors"][1]["componentType"] = 5122;
  EXPECT_THAT(Refusal(document), HasSubstr("/accessors/1 must be unsigned scalars"));
  document = TriangleDocument();
  document["buffers"][1] = {{"byteLength", 12}, {"uri", DataUriOf<uint16_t>({0, 0, 1, 0, 2, 0})}};
  document["bufferViews"][1] = {{"buffer", 1}, {"byteLength", 12}, {"byteStride", 4}};
  EXPECT_THAT(Refusal(document), HasSubstr("/bufferViews/1 must not have a stride"));
}

TEST(MeshCheck, MorphTargetsAreThoseOfAllPrimitivesAndWeights) {
  json document = TriangleDocument();
  json& mesh = document["meshes"][0];
  const json target = {{"POSITION", 0}};
  mesh["primitives"][0]["targets"] = {target};
  mesh["weights"] = {0.5};
  EXPECT_EQ(Refusal(document), "");
  mesh["weights"] = {0.5, 0.5};
  EXPECT_THAT(Refusal(document), HasSubstr("/meshes/0/weights: 2 weights for 1 morph targets"));
  mesh["weights"] = {0.5};
  mesh["primitives"].push_back(TriangleDocument()["meshes"][0]["primitives"][0]);
  EXPECT_THAT(Refusal(document), HasSubstr("/meshes/0/primitives/1/targets: must be 1"));
  document = TriangleDocument();
  const int normals = AddAccessor(document, "VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  document["meshes"][0]["primitives"][0]["targets"] = {{{"NORMAL", normals}}};
  EXPECT_THAT(Refusal(document), HasSubstr("is not among the primitive's attributes"));
}

TEST(MeshCheck, JointsHaveWeights) {
  json document = TriangleDocument();
  Attributes(document)["JOINTS_0"] = AddZeros(document, 5121, "VEC4", 4);
  EXPECT_THAT(Refusal(document), HasSubstr("1 JOINTS and 0 WEIGHTS do not go together"));
}

TEST(MeshCheck, InterleavedVerticesSayTheirStride) {
  json document = TriangleDocument();
  document["buffers"][0] = {{"byteLength", 72}, {"uri", DataUriOf(std::vector<float>(18, 0.0f))}};
  document["bufferViews"][0] = {{"buffer", 0}, {"byteLength", 72}, {"byteStride", 24}};
  document["accessors"].push_back({{"bufferView", 0},
                                   {"byteOffset", 12},
                                   {"componentType", 5126},
                                   {"count", 3},
                                   {"type", "VEC3"}});
  Attributes(document)["NORMAL"] = 2;
  EXPECT_EQ(Refusal(document), "");
  document["bufferViews"][0].erase("byteStride");
  document["accessors"][2]["byteOffset"] = 36;
  EXPECT_THAT(Refusal(document),
              HasSubstr("/bufferViews/0: 2 accessors of vertices share it, so it must have a "
                        "byteStride"));
}

}  // namespace
}  // namespace fenestra::gltf
