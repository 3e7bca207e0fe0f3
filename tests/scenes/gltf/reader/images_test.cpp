#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/scenes/gltf/gltf_text.h"

namespace fenestra {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::Png;
using testing::Refusal;

json TexturedTriangle(const std::vector<uint8_t>& image) {
  json document = testing::TriangleDocument();
  document["images"] = {{{"uri", testing::DataUri(image)}}};
  document["textures"] = {{{"source", 0}}};
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  auto& primitive = document["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["attributes"]["TEXCOORD_0"] =
      testing::AddAccessor(document, "VEC2", {0, 0, 0.25f, 0, 0, 1});
  return document;
}

std::vector<uint8_t> Encode(const std::string& extension, const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  cv::imencode(extension, image, bytes);
  return bytes;
}

glm::u8vec4 FirstTexel(const std::vector<uint8_t>& image) {
  return testing::ReadDocument(TexturedTriangle(image)).scene.textures.at(0).texels.at(0);
}

TEST(GltfImages, EveryKindOfPictureBecomesRgba) {
  EXPECT_EQ(FirstTexel(Png(2, 2, {10, 20, 30, 40})), glm::u8vec4(10, 20, 30, 40));
  EXPECT_EQ(FirstTexel(Encode(".png", cv::Mat3b(1, 1, cv::Vec3b(30, 20, 10)))),
            glm::u8vec4(10, 20, 30, 255));
  EXPECT_EQ(FirstTexel(Encode(".png", cv::Mat1b(1, 1, uint8_t{77}))), glm::u8vec4(77, 77, 77, 255));
  // 16 bits a channel: 257 v is v in 8 bits.
  EXPECT_EQ(FirstTexel(Encode(".png", cv::Mat3w(1, 1, cv::Vec3w(257 * 30, 257 * 20, 257 * 10)))),
            glm::u8vec4(10, 20, 30, 255));
  // Uniform grey survives JPEG exactly.
  EXPECT_EQ(FirstTexel(Encode(".jpg", cv::Mat3b(8, 8, cv::Vec3b(128, 128, 128)))),
            glm::u8vec4(128, 128, 128, 255));
}

TEST(GltfImages, ACutOffPictureIsRefusedAtEveryLength) {
  const cv::Mat3b noise = cv::Mat3b(16, 16, cv::Vec3b(1, 2, 3)) + cv::Scalar(20, 90, 7);
  for (const char* extension : {".png", ".jpg"}) {
    const std::vector<uint8_t> whole = Encode(extension, noise);
    EXPECT_EQ(Refusal(TexturedTriangle(whole)), "") << extension;
    for (size_t size = 1; size < whole.size(); ++size) {
      const std::vector<uint8_t> part(whole.begin(), whole.begin() + static_cast<int>(size));
      EXPECT_THAT(Refusal(TexturedTriangle(part)), HasSubstr("/images/0")) << extension << size;
    }
  }
}

// A header may claim any size; it is believed before anything is decompressed.
TEST(GltfImages, DecompressionBombsAreRefusedByTheirHeader) {
  std::vector<uint8_t> bomb = Png(2, 2, {0, 0, 0, 255});
  bomb[16] = 0x7F;  // Width, big-endian, behind signature, length and type.
  EXPECT_THAT(Refusal(TexturedTriangle(bomb)), HasSubstr("at most 16384 a side"));
  EXPECT_THAT(Refusal(TexturedTriangle(Png(20, 10, {0, 0, 0, 255})), {.max_image_pixels = 199}),
              HasSubstr("/images/0: with its 20 x 10 pixels"));
  EXPECT_EQ(Refusal(TexturedTriangle(Png(20, 10, {0, 0, 0, 255})), {.max_image_pixels = 200}), "");
}

// A triangle and its picture share the memory that a scene may have.
TEST(GltfImages, PixelsCountAsMemory) {
  const json document = TexturedTriangle(Png(20, 10, {0, 0, 0, 255}));
  EXPECT_EQ(Refusal(document, {.max_memory_bytes = 10'000}), "");
  EXPECT_THAT(Refusal(document, {.max_memory_bytes = 5'000}), HasSubstr("more memory than"));
}

TEST(GltfImages, OnePictureInManyTexturesCountsManyTimes) {
  json document = TexturedTriangle(Png(20, 10, {0, 0, 0, 255}));
  document["textures"].push_back({{"source", 0}});
  document["materials"].push_back(document["materials"][0]);
  document["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
  EXPECT_EQ(Refusal(document, {.max_image_pixels = 400}), "");
  EXPECT_THAT(Refusal(document, {.max_image_pixels = 399}), HasSubstr("/textures/1"));
}

TEST(GltfImages, OtherFormatsAreRefusedUnlessAnExtensionBringsThem) {
  const std::vector<uint8_t> webp = {'R', 'I', 'F', 'F', 0, 0, 0, 0, 'W', 'E', 'B', 'P'};
  json document = TexturedTriangle(webp);
  EXPECT_THAT(Refusal(document), HasSubstr("/images/0: not a PNG or JPEG image"));
  document["extensionsUsed"] = {"EXT_texture_webp"};
  document["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
  EXPECT_EQ(Refusal(document), "");
}

TEST(GltfImages, DamagedPixelsAreRefused) {
  std::vector<uint8_t> damaged = Png(64, 64, {1, 2, 3, 255});
  for (size_t i = 45; i < damaged.size() - 20; ++i) damaged[i] ^= 0x5A;
  EXPECT_THAT(Refusal(TexturedTriangle(damaged)), HasSubstr("/images/0"));
}

}  // namespace
}  // namespace fenestra
