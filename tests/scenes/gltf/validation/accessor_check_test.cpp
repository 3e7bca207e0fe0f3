#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenes/gltf/gltf_text.h"

namespace fenestra {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::Refusal;
using testing::TriangleDocument;

std::string RefusalWith(const char* pointer, const json& value) {
  json document = TriangleDocument();
  document[json::json_pointer(pointer)] = value;
  return Refusal(document);
}

TEST(AccessorCheck, RulesAreKeptByAccessorsThatNothingReads) {
  const json plain = {{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}};
  EXPECT_EQ(RefusalWith("/accessors/2", plain), "");
  json moved = plain;
  moved["byteOffset"] = 0;
  EXPECT_THAT(RefusalWith("/accessors/2", moved),
              HasSubstr("/accessors/2/byteOffset: needs 'bufferView'"));
}

TEST(AccessorCheck, FloatsAreNotNormalised) {
  EXPECT_THAT(RefusalWith("/accessors/0/normalized", true),
              HasSubstr("/accessors/0/normalized: only"));
  EXPECT_EQ(RefusalWith("/accessors/0/normalized", false), "");
}

}  // namespace
}  // namespace fenestra
