#include "scenes/gltf/validation/structure_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "tests/scenes/gltf/gltf_text.h"

namespace fenestra::gltf {
namespace {

using fenestra::testing::TriangleDocument;
using nlohmann::json;
using ::testing::HasSubstr;

// All faults of a document, or "".
std::string FaultsIn(const json& document) {
  Faults faults("scene.gltf");
  CheckSchema(document, faults);
  try {
    faults.ThrowIfAny();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Of the sound document with one value put at a place of its own.
std::string With(const std::string& pointer, const json& value) {
  json document = TriangleDocument();
  document[json::json_pointer(pointer)] = value;
  return FaultsIn(document);
}

std::string Without(const std::string& pointer) {
  json document = TriangleDocument();
  const json::json_pointer place(pointer);
  document[place.parent_pointer()].erase(place.back());
  return FaultsIn(document);
}

TEST(SchemaCheck, ASoundDocumentHasNoFaults) {
  EXPECT_EQ(FaultsIn(TriangleDocument()), "");
  EXPECT_EQ(FaultsIn(json::parse(R"({"asset": {"version": "2.0"}})")), "");
}

TEST(SchemaCheck, MembersThatAreRequiredMayNotBeMissing) {
  EXPECT_THAT(Without("/asset/version"), HasSubstr("/asset: 'version' is missing"));
  EXPECT_THAT(Without("/accessors/0/count"), HasSubstr("/accessors/0: 'count' is missing"));
  EXPECT_THAT(Without("/buffers/0/byteLength"), HasSubstr("'byteLength' is missing"));
  EXPECT_THAT(Without("/meshes/0/primitives/0/attributes"), HasSubstr("'attributes' is missing"));
  EXPECT_EQ(Without("/bufferViews/0/byteOffset"), "");
}

TEST(SchemaCheck, EachKindOfValueIsHeldToIt) {
  EXPECT_THAT(With("/accessors/0/count", "3"), HasSubstr("/accessors/0/count: must be an integer"));
  EXPECT_THAT(With("/accessors/0/count", 3.5), HasSubstr("must be an integer"));
  EXPECT_THAT(With("/nodes/0/scale", json::array({1, 1, "1"})),
              HasSubstr("/nodes/0/scale/2: must be a number"));
  EXPECT_THAT(With("/accessors/0/normalized", 1), HasSubstr("must be true or false"));
  EXPECT_THAT(With("/nodes/0/name", 7), HasSubstr("/nodes/0/name: must be a string"));
  EXPECT_THAT(With("/nodes/0", json::array()), HasSubstr("/nodes/0: must be an object, not array"));
  EXPECT_THAT(With("/nodes", json::object()), HasSubstr("/nodes: must be an array, not object"));
}

TEST(SchemaCheck, NumbersStayInTheirRange) {
  EXPECT_THAT(With("/accessors/0/count", 0), HasSubstr("must be at least 1, not 0"));
  EXPECT_THAT(With("/bufferViews/0/byteStride", 300), HasSubstr("must be at most 252, not 300"));
  json camera =
      json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0, "znear": 0.1}}])");
  EXPECT_THAT(With("/cameras", camera), HasSubstr("/cameras/0/perspective/yfov: must be above 0"));
  // Beyond 2^53 the integers of JSON blur.
  EXPECT_THAT(With("/accessors/0/byteOffset", uint64_t{1} << 54), HasSubstr("must be at most"));
}

TEST(SchemaCheck, WordsAndCodesAreThoseOfTheSpecification) {
  EXPECT_THAT(With("/accessors/0/type", "VEC5"), HasSubstr("must be one of SCALAR, VEC2"));
  EXPECT_THAT(With("/accessors/0/componentType", 5124), HasSubstr("must be one of 5120, 5121"));
  EXPECT_THAT(With("/meshes/0/primitives/0/mode", 7), HasSubstr("must be one of 0, 1, 2"));
}

TEST(SchemaCheck, ArraysHaveTheirLength) {
  EXPECT_THAT(With("/nodes/0/matrix", json::array({1, 2, 3})),
              HasSubstr("/nodes/0/matrix: must have 16 elements, not 3"));
  EXPECT_THAT(With("/accessors/0/min", std::vector<int>(17, 0)),
              HasSubstr("must have at most 16 elements, not 17"));
  EXPECT_THAT(With("/nodes/0/children", json::array()), HasSubstr("must not be empty"));
  EXPECT_THAT(With("/scenes/0/nodes", json::array({0, 0})),
              HasSubstr("/scenes/0/nodes/1: 0 is there twice"));
}

TEST(SchemaCheck, ReferencesPointAtWhatIsThere) {
  EXPECT_THAT(With("/nodes/0/mesh", 1),
              HasSubstr("/nodes/0/mesh: 1 does not exist; there is 1 in 'meshes'"));
  EXPECT_THAT(With("/nodes/0/mesh", -1), HasSubstr("-1 does not exist"));
  EXPECT_THAT(With("/nodes/0/skin", 0), HasSubstr("there are 0 in 'skins'"));
  EXPECT_THAT(With("/nodes/0/mesh", 0.0), HasSubstr("must be an integer"));
  EXPECT_THAT(With("/meshes/0/primitives/0/attributes/TEXCOORD_0", 9),
              HasSubstr("/meshes/0/primitives/0/attributes/TEXCOORD_0: 9 does not exist"));
  EXPECT_THAT(With("/meshes/0/primitives/0/attributes", json::object()),
              HasSubstr("must not be empty"));
}

TEST(SchemaCheck, ExtensionsAreDeclaredAndStandWhereTheyBelong) {
  json document = TriangleDocument();
  document["extensionsUsed"] = {"KHR_node_visibility"};
  document["nodes"][0]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
  EXPECT_EQ(FaultsIn(document), "");
  document["nodes"][0]["extensions"]["KHR_node_visibility"] = {{"visible", 0}};
  EXPECT_THAT(FaultsIn(document), HasSubstr("must be true or false"));
  document = TriangleDocument();
  document["nodes"][0]["extensions"]["KHR_node_visibility"] = {{"visible", false}};
  EXPECT_THAT(FaultsIn(document), HasSubstr("is not in 'extensionsUsed'"));
  document = TriangleDocument();
  document["extensionsUsed"] = {"KHR_node_visibility", "VENDOR_other"};
  document["meshes"][0]["extensions"]["KHR_node_visibility"] = json::object();
  EXPECT_THAT(FaultsIn(document), HasSubstr("does not belong here"));
  // What others define may stand anywhere, if it is an object.
  document["meshes"][0]["extensions"] = {{"VENDOR_other", json::object()}};
  EXPECT_EQ(FaultsIn(document), "");
  document["meshes"][0]["extensions"] = {{"VENDOR_other", 1}};
  EXPECT_THAT(FaultsIn(document), HasSubstr("must be an object"));
}

TEST(SchemaCheck, OnlyOurOwnExtrasAreClosed) {
  EXPECT_EQ(With("/nodes/0/extras", json{{"anything", 1}}), "");
  EXPECT_EQ(With("/nodes/0/extras", 3), "");
  EXPECT_EQ(With("/nodes/0/sparkle", 3), "") << "glTF lets unknown members pass";
  EXPECT_THAT(With("/meshes/0/extras", json{{"fenestra", {{"closd", true}}}}),
              HasSubstr("/meshes/0/extras/fenestra/closd: is not known here"));
  EXPECT_THAT(With("/meshes/0/extras", json{{"fenestra", {{"closd", true}}}}),
              HasSubstr("Did you mean 'closed'?"));
}

// Tokens of JSON pointers write "/" as "~1" and "~" as "~0" (RFC 6901).
TEST(SchemaCheck, PlacesAreJsonPointers) {
  EXPECT_THAT(With("/meshes/0/primitives/0/attributes/_A~1B~0C", 9),
              HasSubstr("/attributes/_A~1B~0C: 9 does not exist"));
}

TEST(SchemaCheck, AllFaultsAreReportedAtOnce) {
  json document = TriangleDocument();
  document["accessors"][0].erase("type");
  document["bufferViews"][1]["buffer"] = 4;
  document["nodes"][0]["scale"] = {1};
  const std::string faults = FaultsIn(document);
  for (const char* place : {"/accessors/0", "/bufferViews/1/buffer", "/nodes/0/scale"}) {
    EXPECT_THAT(faults, HasSubstr(place));
  }
}

}  // namespace
}  // namespace fenestra::gltf
