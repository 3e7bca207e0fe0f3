#include "scenes/gltf/writer/material_writer.h"

#include <gtest/gtest.h>

namespace fenestra::gltf {
namespace {

TEST(MaterialWriterTest, LightIsSplitIntoFractionsAndAScaleWithoutRounding) {
  for (const glm::vec3& light : {glm::vec3(0.0f, 0.25f, 1.0f), glm::vec3(3.7f, 0.1f, 1234.5f),
                                 glm::vec3(1e-6f, 1e6f, 0.3f)}) {
    const ScaledLight scaled = SplitScale(light);
    ASSERT_EQ(scaled.fraction.size(), 3u);
    for (int i = 0; i < 3; ++i) {
      const double fraction = scaled.fraction[static_cast<size_t>(i)];
      EXPECT_GE(fraction, 0.0);
      EXPECT_LE(fraction, 1.0);
      EXPECT_EQ(static_cast<float>(fraction * scaled.scale), light[i]);
    }
  }
}

TEST(MaterialWriterTest, LightThatFitsHasTheScaleOne) {
  EXPECT_EQ(SplitScale(glm::vec3(0.5f, 1.0f, 0.0f)).scale, 1.0);
}

TEST(BufferBuilderTest, EveryPieceOfDataGetsAViewOfItsOwn) {
  tinygltf::Model model;
  BufferBuilder buffer(model);
  EXPECT_EQ(buffer.AddVertices(std::vector<glm::vec2>(3, glm::vec2(0.5f))), 0);
  EXPECT_EQ(buffer.AddTriangles({glm::uvec3(0, 1, 2)}), 1);
  EXPECT_EQ(model.accessors[0].count, 3u);
  EXPECT_EQ(model.accessors[1].count, 3u);
  ASSERT_EQ(model.bufferViews.size(), 2u);
  // Components of four bytes begin at multiples of four.
  EXPECT_EQ(model.bufferViews[1].byteOffset % 4, 0u);
}

}  // namespace
}  // namespace fenestra::gltf
