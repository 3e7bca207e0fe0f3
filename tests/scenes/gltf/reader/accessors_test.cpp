#include "scenes/gltf/reader/accessors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/io/input_error.h"
#include "tests/scenes/gltf/gltf_text.h"
#include "tests/support/temporary_folder.h"

namespace fenestra::gltf {
namespace {

using fenestra::testing::DataUriOf;
using fenestra::testing::TemporaryFolder;
using fenestra::testing::TriangleDocument;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kByte = 5120;
constexpr int kUnsignedByte = 5121;
constexpr int kShort = 5122;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

Asset LoadDocument(const json& document) {
  const TemporaryFolder folder;
  return LoadAsset(folder.Write("scene.gltf", document.dump()), {});
}

// A document whose accessor 2 lies over these values in a view of its own.
template <typename T>
json WithAccessor(const std::vector<T>& values, json accessor, json view = json::object()) {
  json document = TriangleDocument();
  const size_t bytes = values.size() * sizeof(T);
  document["buffers"].push_back({{"byteLength", bytes}, {"uri", DataUriOf(values)}});
  view["buffer"] = 2;
  view["byteLength"] = bytes;
  document["bufferViews"].push_back(view);
  accessor["bufferView"] = 2;
  document["accessors"].push_back(accessor);
  return document;
}

template <typename T>
std::vector<float> FloatsOf(const std::vector<T>& values, int component_type, bool normalized) {
  return ReadFloats(LoadDocument(WithAccessor(values, {{"componentType", component_type},
                                                       {"count", values.size()},
                                                       {"type", "SCALAR"},
                                                       {"normalized", normalized}})),
                    2);
}

std::string RefusalWhile(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Section 3.11 of the specification: f = c/255, max(c/127, -1), …
TEST(Accessors, NormalisedIntegersBecomeFractions) {
  EXPECT_THAT(FloatsOf<uint8_t>({0, 51, 255}, kUnsignedByte, true), ElementsAre(0.0f, 0.2f, 1.0f));
  EXPECT_THAT(FloatsOf<int8_t>({-128, -127, 0, 127}, kByte, true),
              ElementsAre(-1.0f, -1.0f, 0.0f, 1.0f));
  EXPECT_THAT(FloatsOf<uint16_t>({0, 13107, 65535}, kUnsignedShort, true),
              ElementsAre(0.0f, 0.2f, 1.0f));
  EXPECT_THAT(FloatsOf<int16_t>({-32768, -32767, 32767}, kShort, true),
              ElementsAre(-1.0f, -1.0f, 1.0f));
}

TEST(Accessors, OtherIntegersKeepTheirValue) {
  EXPECT_THAT(FloatsOf<uint8_t>({0, 255}, kUnsignedByte, false), ElementsAre(0.0f, 255.0f));
  EXPECT_THAT(FloatsOf<int16_t>({-32768, 7}, kShort, false), ElementsAre(-32768.0f, 7.0f));
  const Asset asset = LoadDocument(WithAccessor<uint32_t>(
      {0, 4'000'000'000}, {{"componentType", kUnsignedInt}, {"count", 2}, {"type", "SCALAR"}}));
  EXPECT_THAT(ReadUnsigned(asset, 2), ElementsAre(0u, 4'000'000'000u));
}

TEST(Accessors, FloatsKeepTheirBits) {
  const std::vector<float> values = {0.1f, -1e-38f, 3e38f,
                                     std::numeric_limits<float>::denorm_min()};
  EXPECT_EQ(FloatsOf(values, kFloat, false), values);
}

TEST(Accessors, VectorsAreTakenApartFromAnInterleavedView) {
  // A position and a colour for each of two vertices.
  const std::vector<float> vertices = {1, 2, 3, 10, 20, 30, 4, 5, 6, 40, 50, 60};
  json document = WithAccessor(
      vertices, {{"componentType", kFloat}, {"count", 2}, {"type", "VEC3"}}, {{"byteStride", 24}});
  document["accessors"].push_back({{"bufferView", 2},
                                   {"byteOffset", 12},
                                   {"componentType", kFloat},
                                   {"count", 2},
                                   {"type", "VEC3"}});
  const Asset asset = LoadDocument(document);
  EXPECT_THAT(ReadVec3(asset, 2), ElementsAre(glm::vec3(1, 2, 3), glm::vec3(4, 5, 6)));
  EXPECT_THAT(ReadVec3(asset, 3), ElementsAre(glm::vec3(10, 20, 30), glm::vec3(40, 50, 60)));
  // A colour without alpha is opaque.
  EXPECT_THAT(ReadVec4(asset, 3), ElementsAre(glm::vec4(10, 20, 30, 1), glm::vec4(40, 50, 60, 1)));
}

// Columns of matrices of bytes begin at multiples of four bytes (section 3.6.2.4).
TEST(Accessors, ColumnsOfSmallMatricesArePadded) {
  const std::vector<uint8_t> bytes = {1, 2, 99, 99, 3, 4, 99, 99};
  const Asset asset = LoadDocument(
      WithAccessor(bytes, {{"componentType", kUnsignedByte}, {"count", 1}, {"type", "MAT2"}}));
  EXPECT_THAT(ReadFloats(asset, 2), ElementsAre(1.0f, 2.0f, 3.0f, 4.0f));
}

TEST(Accessors, WithoutAViewAllElementsAreZero) {
  json document = TriangleDocument();
  document["accessors"].push_back({{"componentType", kFloat}, {"count", 2}, {"type", "VEC2"}});
  EXPECT_THAT(ReadVec2(LoadDocument(document), 2), ElementsAre(glm::vec2(0, 0), glm::vec2(0, 0)));
}

TEST(Accessors, SparseValuesReplaceThoseUnderneath) {
  json document = WithAccessor<float>(
      {10, 11, 12, 13}, {{"componentType", kFloat}, {"count", 4}, {"type", "SCALAR"}});
  document["buffers"].push_back(
      {{"byteLength", 16}, {"uri", DataUriOf<uint32_t>({1, 3, 0x40000000u, 0x40400000u})}});
  document["bufferViews"].push_back({{"buffer", 3}, {"byteLength", 16}});
  document["accessors"][2]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", 3}, {"componentType", kUnsignedInt}}},
      {"values", {{"bufferView", 3}, {"byteOffset", 8}}}};
  EXPECT_THAT(ReadFloats(LoadDocument(document), 2), ElementsAre(10.0f, 2.0f, 12.0f, 3.0f));
  // Without a view below, the others are zero.
  document["accessors"][2].erase("bufferView");
  EXPECT_THAT(ReadFloats(LoadDocument(document), 2), ElementsAre(0.0f, 2.0f, 0.0f, 3.0f));
}

TEST(Accessors, WhatIsNotFiniteIsRefusedWithItsElement) {
  json document = WithAccessor<float>({0, 0, 0, 0, std::numeric_limits<float>::infinity(), 0},
                                      {{"componentType", kFloat}, {"count", 2}, {"type", "VEC3"}});
  const Asset asset = LoadDocument(document);
  EXPECT_THAT(RefusalWhile([&] { ReadVec3(asset, 2); }),
              HasSubstr("/accessors/2: element 1 is not finite"));
}

TEST(Accessors, ABufferWithoutDataIsRefusedWhenItIsRead) {
  json document =
      WithAccessor<float>({0, 0}, {{"componentType", kFloat}, {"count", 2}, {"type", "SCALAR"}});
  document["buffers"][2].erase("uri");
  const Asset asset = LoadDocument(document);
  EXPECT_THAT(RefusalWhile([&] { ReadFloats(asset, 2); }), HasSubstr("/buffers/2: has no data"));
}

}  // namespace
}  // namespace fenestra::gltf
