#include "scenes/gltf/reader/asset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "tests/scenes/gltf/gltf_text.h"
#include "tests/support/temporary_folder.h"

namespace fenestra::gltf {
namespace {

using fenestra::testing::DataUri;
using fenestra::testing::Refusal;
using fenestra::testing::TemporaryFolder;
using fenestra::testing::TriangleDocument;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Asset LoadBytes(const TemporaryFolder& folder, const std::string& name, const std::string& bytes,
                const GltfReadOptions& options = {}) {
  return LoadAsset(folder.Write(name, bytes), options);
}

Asset Load(const json& document) {
  const TemporaryFolder folder;
  return LoadBytes(folder, "scene.gltf", document.dump());
}

std::string Text(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

TEST(Asset, HoldsTheDocumentAndTheBytesItRefersTo) {
  const Asset asset = Load(TriangleDocument());
  EXPECT_EQ(asset.model.meshes.size(), 1u);
  EXPECT_EQ(asset.model.meshes[0].primitives[0].indices, 1);
  ASSERT_EQ(asset.buffers.size(), 2u);
  EXPECT_EQ(asset.buffers[0]->size(), 36u);
  EXPECT_EQ(asset.buffers[1]->size(), 6u);
  // What tinygltf is not shown it cannot misread.
  EXPECT_TRUE(asset.model.buffers.empty());
  EXPECT_TRUE(asset.ignored_extensions.empty());
}

TEST(Asset, TheFirstBufferOfABinaryFileIsItsChunk) {
  json document = TriangleDocument();
  document["buffers"][0].erase("uri");
  std::string chunk(36, '\0');
  chunk[4] = 'x';
  const TemporaryFolder folder;
  const Asset asset =
      LoadBytes(folder, "scene.glb",
                fenestra::testing::Glb({{fenestra::testing::kJsonChunk, document.dump()},
                                        {fenestra::testing::kBinaryChunk, chunk}}));
  EXPECT_EQ(Text(asset.buffers[0].value()), chunk);
}

TEST(Asset, FilesBesideItAreRead) {
  json document = TriangleDocument();
  document["buffers"][0]["uri"] = "my%20data.bin";
  const TemporaryFolder folder;
  folder.Write("my data.bin", std::string(40, 'y'));
  const Asset asset = LoadBytes(folder, "scene.gltf", document.dump());
  EXPECT_EQ(Text(asset.buffers[0].value()), std::string(40, 'y'));
}

TEST(Asset, ABufferMayBeLongerThanItSaysAndNotShorter) {
  json document = TriangleDocument();
  document["buffers"][0]["byteLength"] = 37;
  EXPECT_THAT(Refusal(document), HasSubstr("/buffers/0: has 36 bytes instead of the 37"));
  document["buffers"][0]["byteLength"] = 36;
  document["buffers"][0]["uri"] = DataUri(std::vector<uint8_t>(50, 0));
  EXPECT_NO_THROW(Load(document));
}

TEST(Asset, ABufferWithoutUriHasNoContent) {
  json document = TriangleDocument();
  document["buffers"].push_back({{"byteLength", 100}});
  EXPECT_FALSE(Load(document).buffers[2].has_value());
}

TEST(Asset, AnImageIsAFileOrAPartOfABuffer) {
  const std::vector<uint8_t> png = fenestra::testing::Png(2, 2, {10, 20, 30, 255});
  json document = TriangleDocument();
  document["buffers"].push_back({{"byteLength", png.size()}, {"uri", DataUri(png)}});
  document["bufferViews"].push_back({{"buffer", 2}, {"byteLength", png.size()}});
  document["images"] = json::array();
  document["images"].push_back({{"bufferView", 2}, {"mimeType", "image/png"}});
  document["images"].push_back({{"uri", DataUri(png)}});
  const Asset asset = Load(document);
  ASSERT_EQ(asset.images.size(), 2u);
  EXPECT_EQ(asset.images[0], asset.images[1]);
  EXPECT_EQ(asset.images[0].size(), png.size());
}

TEST(Asset, AnImageThatIsBothOrNeitherIsRefused) {
  json document = TriangleDocument();
  document["images"] = json::array();
  document["images"].push_back({{"name", "nothing"}});
  document["images"].push_back({{"bufferView", 0}, {"uri", "a.png"}, {"mimeType", "image/png"}});
  document["images"].push_back({{"bufferView", 0}});
  EXPECT_THAT(Refusal(document),
              AllOf(HasSubstr("/images/0: must have either a 'uri' or a 'bufferView'"),
                    HasSubstr("/images/1: must have either"),
                    HasSubstr("/images/2: 'mimeType' is missing")));
}

TEST(Asset, AllFilesThatAreMissingAreNamedAtOnce) {
  json document = TriangleDocument();
  document["buffers"][0]["uri"] = "one.bin";
  document["buffers"][1]["uri"] = "two.bin";
  EXPECT_THAT(Refusal(document),
              AllOf(ContainsRegex("/buffers/0/uri: [^\n]*one\\.bin: no such file"),
                    ContainsRegex("/buffers/1/uri: [^\n]*two\\.bin: no such file")));
}

TEST(Asset, ALongUriIsShownInPart) {
  json document = TriangleDocument();
  document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + std::string(5000, '*');
  EXPECT_LT(Refusal(document).size(), 500u);
}

TEST(Asset, ViewsOfABufferCountAgainstTheLimitToo) {
  const std::vector<uint8_t> png = fenestra::testing::Png(64, 64, {10, 20, 30, 255});
  json document = TriangleDocument();
  document["buffers"].push_back({{"byteLength", png.size()}, {"uri", DataUri(png)}});
  document["bufferViews"].push_back({{"buffer", 2}, {"byteLength", png.size()}});
  document["images"] = json::array();
  for (int i = 0; i < 100; ++i) {
    document["images"].push_back({{"bufferView", 2}, {"mimeType", "image/png"}});
  }
  const size_t text = document.dump().size();
  EXPECT_THAT(Refusal(document, {.max_file_bytes = text + 50 * png.size()}),
              HasSubstr("more data than is read for one scene"));
}

// tinygltf itself refuses indices whose accessor has no view, though these are legal zeros.
TEST(Asset, IndicesWithoutAViewAreZeros) {
  json document = TriangleDocument();
  document["accessors"][1].erase("bufferView");
  EXPECT_EQ(Load(document).model.meshes[0].primitives[0].indices, 1);
}

TEST(Asset, UnknownExtensionsAreIgnoredAndRequiredOnesRefused) {
  json document = TriangleDocument();
  document["extensionsUsed"] = {"VENDOR_sparkle"};
  EXPECT_THAT(Load(document).ignored_extensions, ElementsAre("VENDOR_sparkle"));
  document["extensionsRequired"] = {"VENDOR_sparkle"};
  EXPECT_THAT(Refusal(document), HasSubstr("requires VENDOR_sparkle"));
}

}  // namespace
}  // namespace fenestra::gltf
