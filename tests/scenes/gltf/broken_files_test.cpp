#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <limits>

#include "tests/scenes/gltf/gltf_text.h"
#include "tests/support/temporary_folder.h"

// Files that mean ill, each made here from a sound one: a clear error, never a crash.

namespace fenestra {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::Refusal;
using testing::RefusalOfBytes;
using testing::TemporaryFolder;
using testing::TriangleDocument;

TEST(BrokenGltf, TheSoundFileThatTheOthersAreMadeOfIsRead) {
  EXPECT_EQ(Refusal(TriangleDocument()), "");
}

TEST(BrokenGltf, AllFaultsAreReportedAtOnceWithTheirPlaces) {
  json document = TriangleDocument();
  document["accessors"][0]["bufferView"] = 7;
  document["nodes"][0]["mesh"] = -1;
  document["nodes"][0]["children"] = json::array();
  const std::string refusal = Refusal(document);
  EXPECT_THAT(refusal, HasSubstr("/accessors/0/bufferView: 7 does not exist; there are 2"));
  EXPECT_THAT(refusal, HasSubstr("/nodes/0/mesh: -1 does not exist; there is 1"));
  EXPECT_THAT(refusal, HasSubstr("/nodes/0/children: must not be empty"));
}

TEST(BrokenGltf, ASkinNeedsAMeshWithJoints) {
  json skinned = TriangleDocument();
  skinned["skins"] = {{{"joints", {0}}}};
  skinned["nodes"][0]["skin"] = 0;
  EXPECT_THAT(Refusal(skinned), HasSubstr("/nodes/0/skin: /meshes/0 has no JOINTS_0"));
}

TEST(BrokenGltf, AContainerWithoutItsBinaryChunkIsRefused) {
  json document = TriangleDocument();
  EXPECT_EQ(RefusalOfBytes(testing::Glb({{testing::kJsonChunk, document.dump()}}), "a.glb"), "");
  document["buffers"][0].erase("uri");
  EXPECT_THAT(RefusalOfBytes(testing::Glb({{testing::kJsonChunk, document.dump()}}), "a.glb"),
              HasSubstr("/buffers/0: without a 'uri' it is the binary chunk, which is missing"));
}

TEST(BrokenGltf, AByteOrderMarkIsRefused) {
  const std::string text = TriangleDocument().dump();
  EXPECT_EQ(RefusalOfBytes(text), "");
  EXPECT_THAT(RefusalOfBytes("\xEF\xBB\xBF" + text), HasSubstr("byte order mark"));
}

TEST(BrokenGltf, TextThatIsNotJsonIsRefusedWithItsLine) {
  EXPECT_THAT(RefusalOfBytes("{\"asset\":\n  {\"version\" 2}}"), HasSubstr("scene.gltf:2:1"));
  EXPECT_THAT(RefusalOfBytes("{\"asset\": {\"version\": \"\xff\"}}"), HasSubstr("not JSON"));
  EXPECT_THAT(RefusalOfBytes(""), HasSubstr("not JSON"));
  EXPECT_THAT(RefusalOfBytes("[]"), HasSubstr("not an object"));
}

TEST(BrokenGltf, DeepNestingIsRefusedBeforeItOverflowsAnything) {
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  EXPECT_THAT(RefusalOfBytes("{\"extras\": " + deep + "}"), HasSubstr("nested deeper"));
}

TEST(BrokenGltf, MillionsOfValuesAreRefused) {
  std::string zeros = "0";
  for (int i = 0; i < 5'000'000; ++i) zeros += ",0";
  EXPECT_THAT(RefusalOfBytes("{\"extras\": [" + zeros + "]}"), HasSubstr("JSON values"));
}

TEST(BrokenGltf, NumbersThatNoDoubleHoldsAreRefused) {
  json document = TriangleDocument();
  std::string text = document.dump();
  text.insert(text.rfind('}'), ",\"extras\": 1e999");
  EXPECT_THAT(RefusalOfBytes(text), HasSubstr("not JSON"));
  document["nodes"][0]["matrix"] = std::vector<double>(16, 1e300);
  EXPECT_THAT(Refusal(document), HasSubstr("/nodes/0/matrix"));
}

TEST(BrokenGltf, OffsetsThatWouldOverflow32Or64BitsAreRefused) {
  for (const uint64_t offset : {uint64_t{36}, uint64_t{1} << 32, (uint64_t{1} << 53) - 4,
                                std::numeric_limits<uint64_t>::max() - 3}) {
    json document = TriangleDocument();
    document["accessors"][0]["byteOffset"] = offset;
    EXPECT_THAT(Refusal(document), HasSubstr("/accessors/0")) << offset;
    document = TriangleDocument();
    document["bufferViews"][0]["byteOffset"] = offset;
    EXPECT_THAT(Refusal(document), HasSubstr("/bufferViews/0")) << offset;
    document = TriangleDocument();
    document["accessors"][0]["count"] = offset;
    EXPECT_THAT(Refusal(document), HasSubstr("/accessors/0")) << offset;
  }
}

TEST(BrokenGltf, AnIndexBeyondTheVerticesIsRefused) {
  json document = TriangleDocument();
  document["buffers"][1]["uri"] = testing::DataUriOf<uint16_t>({0, 1, 3});
  EXPECT_THAT(Refusal(document), HasSubstr("/accessors/1: element 2 is vertex 3; there are 3"));
}

TEST(BrokenGltf, PositionsThatAreNotNumbersAreRefused) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    json document = TriangleDocument();
    document["buffers"][0]["uri"] = testing::DataUriOf<float>({0, 0, 0, 1, bad, 0, 0, 1, 0});
    EXPECT_THAT(Refusal(document), HasSubstr("/accessors/0: element 1 is not finite"));
  }
}

TEST(BrokenGltf, APlaceBeyondSinglePrecisionIsRefused) {
  json document = TriangleDocument();
  document["nodes"][0]["scale"] = {1e39, 1, 1};
  EXPECT_THAT(Refusal(document), HasSubstr("positions must be finite"));
  document["nodes"] = json::array({{{"mesh", 0}}});
  document["scenes"][0]["nodes"] = {0};
  for (int i = 0; i < 3; ++i) {
    document["nodes"][i]["scale"] = {1e200, 1, 1};
    if (i < 2) document["nodes"][i]["children"] = {i + 1};
  }
  EXPECT_THAT(Refusal(document), HasSubstr("its place in the world is not finite"));
}

TEST(BrokenGltf, LoopsOfNodesAreRefused) {
  json document = TriangleDocument();
  document["nodes"] = json::parse(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])");
  EXPECT_THAT(Refusal(document), HasSubstr("/nodes/1: is its own ancestor"));
  document["nodes"] = json::parse(R"([{"mesh": 0, "children": [0]}])");
  EXPECT_NE(Refusal(document), "");
}

TEST(BrokenGltf, AChainOfAHundredThousandNodesIsReadWithoutRecursion) {
  json document = TriangleDocument();
  document["nodes"] = json::array();
  constexpr int kNodes = 100'000;
  for (int i = 0; i + 1 < kNodes; ++i) document["nodes"].push_back({{"children", {i + 1}}});
  document["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(Refusal(document), "");
}

// 2^40 triangles in a few hundred bytes: each of them is claimed before it is made.
TEST(BrokenGltf, BombsOfInstancesAreRefused) {
  json document = TriangleDocument();
  for (int i = 0; i < 100; ++i) {
    document["nodes"].push_back({{"mesh", 0}});
    document["scenes"][0]["nodes"].push_back(i + 1);
  }
  EXPECT_EQ(Refusal(document, {.max_triangles = 101}), "");
  EXPECT_THAT(Refusal(document, {.max_triangles = 100}), HasSubstr("more than 100 triangles"));

  document = TriangleDocument();
  document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  document["accessors"].push_back(
      {{"componentType", 5126}, {"count", 9'000'000}, {"type", "VEC3"}});
  document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 2;
  EXPECT_THAT(Refusal(document),
              HasSubstr("its 9000000 triangles and 27000000 vertices in 9000000 meshes would need "
                        "about 29 GB of memory; the limit is 1 GB"));
}

TEST(BrokenGltf, AccessorsWithoutDataAreBounded) {
  json document = TriangleDocument();
  document["accessors"].push_back(
      {{"componentType", 5126}, {"count", uint64_t{1} << 40}, {"type", "MAT4"}});
  EXPECT_THAT(Refusal(document), HasSubstr("/accessors/2/count: 1099511627776 elements without"));
}

TEST(BrokenGltf, NothingOutsideTheFolderIsOpened) {
  const TemporaryFolder folder;
  folder.Write("outside.bin", std::string(36, '\0'));
  std::filesystem::create_directory(folder / "inside");
  std::filesystem::create_symlink(folder / "outside.bin", folder / "inside/link.bin");
  std::filesystem::create_directory_symlink(folder.path(), folder / "inside/up");
  folder.Write("inside/a b.bin", std::string(36, '\0'));
  const auto refusal = [&](const std::string& uri) {
    json document = TriangleDocument();
    document["buffers"][0]["uri"] = uri;
    return Refusal(folder.Write("inside/scene.gltf", document.dump()));
  };
  EXPECT_EQ(refusal("a%20b.bin"), "");
  EXPECT_EQ(refusal("a b.bin"), "");  // Not a URI, but what many programs write.
  EXPECT_EQ(refusal("./../inside/a%20b.bin"), "");
  EXPECT_THAT(refusal("../outside.bin"), HasSubstr("leaves the folder"));
  EXPECT_THAT(refusal("%2e%2e/outside.bin"), HasSubstr("leaves the folder"));
  EXPECT_THAT(refusal("..%2Foutside.bin"), HasSubstr("leaves the folder"));
  EXPECT_THAT(refusal("link.bin"), HasSubstr("leaves the folder"));
  EXPECT_THAT(refusal("up/outside.bin"), HasSubstr("leaves the folder"));
  EXPECT_THAT(refusal((folder / "outside.bin").string()), HasSubstr("only relative paths"));
  EXPECT_THAT(refusal("file://" + (folder / "outside.bin").string()), HasSubstr("only data URIs"));
  EXPECT_THAT(refusal("https://example.com/a.bin"), HasSubstr("only data URIs"));
  EXPECT_THAT(refusal("a%00b.bin"), HasSubstr("zero byte"));
  EXPECT_THAT(refusal("a%2"), HasSubstr("hexadecimal"));
  EXPECT_THAT(refusal(""), HasSubstr("empty URI"));
  EXPECT_THAT(refusal("."), HasSubstr("/buffers/0/uri"));
  EXPECT_THAT(refusal("missing.bin"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(std::string(100'000, 'a')), HasSubstr("too long"));
}

TEST(BrokenGltf, DevicesAreNotRead) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.gltf").c_str(), 0600), 0);
  EXPECT_THAT(Refusal(folder / "pipe.gltf"), HasSubstr("not a regular file"));
}

TEST(BrokenGltf, OneFileManyTimesCountsAgainstTheLimit) {
  const TemporaryFolder folder;
  folder.Write("data.bin", std::string(36, '\0'));
  json document = TriangleDocument();
  document["buffers"][0]["uri"] = "data.bin";
  for (int i = 0; i < 1000; ++i) document["buffers"].push_back(document["buffers"][0]);
  const auto file = folder.Write("scene.gltf", document.dump());
  const size_t size = std::filesystem::file_size(file);
  EXPECT_THAT(Refusal(file, {.max_file_bytes = size + 30'000}), HasSubstr("for one scene"));
  EXPECT_EQ(Refusal(file, {.max_file_bytes = size + 40'000}), "");
}

TEST(BrokenGltf, BrokenBase64IsRefused) {
  json document = TriangleDocument();
  for (const char* uri : {"data:", "data:;base64,", "data:;base64,A", "data:;base64,A*==",
                          "data:text/plain,AAAA", "data:;base64,AA=A", "data:;base64,\u00e4AA"}) {
    document["buffers"][0]["uri"] = uri;
    EXPECT_THAT(Refusal(document), HasSubstr("/buffers/0")) << uri;
  }
}

TEST(BrokenGltf, EveryTruncationOfABinaryFileIsRefused) {
  json document = TriangleDocument();
  document["buffers"][0].erase("uri");
  const std::string whole = testing::Glb(
      {{testing::kJsonChunk, document.dump()}, {testing::kBinaryChunk, std::string(36, '\0')}});
  EXPECT_EQ(RefusalOfBytes(whole, "scene.glb"), "");
  for (size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(RefusalOfBytes(whole.substr(0, size), "scene.glb"), "") << size;
  }
}

TEST(BrokenGltf, ABufferWithoutDataIsRefusedOnlyWhereItIsNeeded) {
  json document = TriangleDocument();
  document["buffers"].push_back({{"byteLength", 100}});
  EXPECT_EQ(Refusal(document), "");
  document["buffers"][0].erase("uri");
  EXPECT_THAT(Refusal(document), HasSubstr("/buffers/0: has no data"));
}

TEST(BrokenGltf, SparseIndicesOutOfOrderAreRefused) {
  json document = TriangleDocument();
  document["buffers"].push_back(
      {{"byteLength", 28}, {"uri", testing::DataUriOf<float>({0, 0, 0, 0, 0, 0, 0})}});
  document["bufferViews"].push_back({{"buffer", 2}, {"byteLength", 28}});
  document["accessors"][0]["sparse"] = {{"count", 2},
                                        {"indices", {{"bufferView", 2}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", 2}, {"byteOffset", 4}}}};
  EXPECT_THAT(Refusal(document), HasSubstr("/accessors/0/sparse/indices: 0 follows 0"));
}

TEST(BrokenGltf, UnknownVersionsAreRefused) {
  json document = TriangleDocument();
  for (const char* version : {"1.0", "3.0", "2", "2.0.1", "", "99999999999.0"}) {
    document["asset"]["version"] = version;
    EXPECT_THAT(Refusal(document), HasSubstr("/asset/version")) << version;
  }
  document["asset"]["version"] = "2.7";
  EXPECT_EQ(Refusal(document), "");
}

TEST(BrokenGltf, MisspeltExtrasOfOursAreRefusedWithAHint) {
  json document = TriangleDocument();
  document["nodes"][0]["extras"]["fenestra"]["target_windw"] = {{"width_m", 1}, {"height_m", 1}};
  EXPECT_THAT(Refusal(document), HasSubstr("Did you mean 'target_window'?"));
  document["nodes"][0]["extras"] = {{"other", 1}};
  EXPECT_EQ(Refusal(document), "");
}

}  // namespace
}  // namespace fenestra
