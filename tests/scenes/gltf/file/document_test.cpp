#include "scenes/gltf/file/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "tests/scenes/gltf/gltf_text.h"
#include "tests/support/temporary_folder.h"

namespace fenestra::gltf {
namespace {

constexpr size_t kPlenty = size_t{1} << 20;

Document Read(const std::string& bytes, const std::string& name) {
  const testing::TemporaryFolder folder;
  ByteBudget budget(kPlenty);
  return ReadDocument(folder.Write(name, bytes), budget);
}

TEST(DocumentTest, ATextFileHasNoBinaryChunk) {
  const Document document = Read(R"({"asset": {"version": "2.0"}})", "scene.gltf");
  EXPECT_EQ(document.json["asset"]["version"], "2.0");
  EXPECT_FALSE(document.binary_chunk.has_value());
}

TEST(DocumentTest, ABinaryFileIsTakenApartWhateverItsName) {
  const std::string glb = testing::Glb({{testing::kJsonChunk, R"({"asset": {}})"},
                                        {testing::kBinaryChunk, std::string("\1\2\3\4", 4)}});
  for (const char* name : {"scene.glb", "scene.gltf"}) {
    const Document document = Read(glb, name);
    EXPECT_TRUE(document.json["asset"].is_object()) << name;
    EXPECT_EQ(document.binary_chunk, (Bytes{1, 2, 3, 4})) << name;
  }
}

TEST(DocumentTest, TextThatIsNotJsonIsRefusedWithItsPlace) {
  try {
    Read("{\n  \"asset\": nonsense\n}", "scene.gltf");
    FAIL() << "was read";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1u);
    EXPECT_EQ(error.faults()[0].line, 2);
    EXPECT_THAT(error.faults()[0].message, ::testing::HasSubstr("not JSON"));
  }
}

TEST(DocumentTest, NestingIsLimited) {
  EXPECT_NO_THROW(Read(R"({"a": )" + std::string(60, '[') + std::string(60, ']') + "}", "a.gltf"));
  EXPECT_THROW(Read(R"({"a": )" + std::string(70, '[') + std::string(70, ']') + "}", "a.gltf"),
               InputError);
}

TEST(DocumentTest, PointersEscapeSlashesAndTildes) {
  EXPECT_EQ(MemberPointer("a/b~c"), "/a~1b~0c");
}

}  // namespace
}  // namespace fenestra::gltf
