#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/gltf/reader/materials.h"
#include "tests/scenes/gltf/gltf_text.h"

namespace fenestra {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::ReadDocument;

json WithMaterial(const char* text) {
  json document = testing::TriangleDocument();
  document["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_emissive_strength",
                                "KHR_materials_transmission", "KHR_materials_ior",
                                "KHR_texture_transform"};
  document["materials"] = {json::parse(text)};
  document["meshes"][0]["primitives"][0]["material"] = 0;
  return document;
}

// Also gives the triangle the coordinates (0, 0), (1, 0), (0, 1), as TEXCOORD_1 doubled.
json WithTextures(const char* text, const std::vector<std::array<uint8_t, 4>>& colors) {
  json document = WithMaterial(text);
  for (size_t i = 0; i < colors.size(); ++i) {
    document["images"].push_back({{"uri", testing::DataUri(testing::Png(2, 2, colors[i]))}});
    document["textures"].push_back({{"source", i}});
  }
  const int once = testing::AddAccessor(document, "VEC2", {0, 0, 1, 0, 0, 1});
  const int doubled = testing::AddAccessor(document, "VEC2", {0, 0, 2, 0, 0, 2});
  auto& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_0"] = once;
  attributes["TEXCOORD_1"] = doubled;
  return document;
}

Material Convert(const char* text) {
  return ReadDocument(WithMaterial(text)).scene.materials.at(0);
}

TEST(GltfMaterials, BaseColourIsReflectanceAndIts830nmIsItsLuminance) {
  const Material m = Convert(
      R"({"name": "paint", "pbrMetallicRoughness":
          {"baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 0}})");
  EXPECT_EQ(m.name, "paint");
  EXPECT_EQ(m.reflectance_rgb, glm::vec3(0.5f, 0.25f, 1.0f));
  EXPECT_FLOAT_EQ(m.reflectance_830nm, 0.2126f * 0.5f + 0.7152f * 0.25f + 0.0722f);
  EXPECT_EQ(m.emission_rgb, glm::vec3(0.0f));
}

TEST(GltfMaterials, ExtrasSayWhatGltfCannot) {
  const Material m =
      Convert(R"({"extras": {"fenestra": {"reflectance_830nm": 0.9, "emission_830nm": 2}}})");
  EXPECT_EQ(m.reflectance_830nm, 0.9f);
  EXPECT_EQ(m.emission_830nm, 2.0f);
}

TEST(GltfMaterials, ASurfaceWithoutMaterialIsWhite) {
  const Scene scene = ReadDocument(testing::TriangleDocument()).scene;
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[scene.meshes[0].material].reflectance_rgb, glm::vec3(1.0f));
}

TEST(GltfMaterials, EmissionIsFactorTimesStrengthInCandelaPerSquareMetre) {
  const Material m = Convert(
      R"({"emissiveFactor": [1, 0.5, 0],
          "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 300}}})");
  EXPECT_EQ(m.emission_rgb, glm::vec3(300.0f, 150.0f, 0.0f));
}

TEST(GltfMaterials, UnlitSurfacesShineAndReflectNothing) {
  const Material m = Convert(
      R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1]},
          "extensions": {"KHR_materials_unlit": {}}})");
  EXPECT_EQ(m.reflectance_rgb, glm::vec3(0.0f));
  EXPECT_EQ(m.emission_rgb, glm::vec3(gltf::kUnlitWhite_cd_per_m2) * glm::vec3(1, 0.5f, 0));
}

TEST(GltfMaterials, MostTransmissionIsGlass) {
  const char* glass = R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.9},
                                         "KHR_materials_ior": {"ior": 1.52}}})";
  EXPECT_EQ(Convert(glass).kind, Material::Kind::kGlass);
  EXPECT_EQ(Convert(glass).refractive_index, 1.52f);
  EXPECT_EQ(
      Convert(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.4}}})")
          .kind,
      Material::Kind::kLambert);
}

// alpha_factor · texel < cutoff is where the hole is.
TEST(GltfMaterials, MasksCutWhereFactorTimesTexelIsBelowTheCutoff) {
  EXPECT_EQ(Convert(R"({"alphaMode": "MASK", "alphaCutoff": 0.25,
                        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}})")
                .alpha_cutoff,
            0.5f);
  EXPECT_EQ(Convert(R"({"alphaMode": "MASK"})").alpha_cutoff, 0.5f);
  EXPECT_EQ(Convert(R"({"alphaMode": "BLEND"})").alpha_cutoff, 0.5f);
  EXPECT_EQ(Convert(R"({"alphaMode": "OPAQUE"})").alpha_cutoff, 0.0f);
}

TEST(GltfMaterials, ASurfaceThatIsAllHoleIsLeftOut) {
  const GltfScene gltf = ReadDocument(WithMaterial(
      R"({"name": "air", "alphaMode": "BLEND",
          "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.1], "metallicFactor": 0}})"));
  EXPECT_THAT(gltf.scene.meshes, IsEmpty());
  EXPECT_THAT(gltf.notes, ElementsAre(HasSubstr("material 'air': alpha is not blended"),
                                      HasSubstr("material 'air': transparent everywhere"),
                                      HasSubstr("nothing to see")));
}

TEST(GltfMaterials, MetalIsNotedOnceForAllThatAre) {
  json document = WithMaterial(R"({"name": "a"})");
  for (const char* name : {"b", "c", "d", "e"}) document["materials"].push_back({{"name", name}});
  EXPECT_THAT(ReadDocument(document).notes,
              ElementsAre("material 'a', material 'b', material 'c' and 2 more: metal is rendered "
                          "as matt paint of its colour"));
}

TEST(GltfTextures, SamplersBecomeWrapAndFilter) {
  json document = WithTextures(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
                               {{1, 2, 3, 255}});
  document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  document["textures"][0]["sampler"] = 0;
  const Scene scene = ReadDocument(document).scene;
  EXPECT_EQ(scene.materials[0].texture, 0u);
  EXPECT_EQ(scene.textures.at(0).wrap_u, Texture::Wrap::kClampToEdge);
  EXPECT_EQ(scene.textures[0].wrap_v, Texture::Wrap::kMirroredRepeat);
  EXPECT_FALSE(scene.textures[0].interpolated);
}

std::vector<glm::vec2> Coordinates(const char* texture_info) {
  const std::string text =
      std::string(R"({"pbrMetallicRoughness": {"baseColorTexture": )") + texture_info + "}}";
  return ReadDocument(WithTextures(text.c_str(), {{1, 2, 3, 255}}))
      .scene.meshes.at(0)
      .texture_coordinates;
}

TEST(GltfTextures, TheCoordinateSetIsChosenAndTheTransformMayOverrideIt) {
  using V = glm::vec2;
  EXPECT_THAT(Coordinates(R"({"index": 0})"), ElementsAre(V(0, 0), V(1, 0), V(0, 1)));
  EXPECT_THAT(Coordinates(R"({"index": 0, "texCoord": 1})"),
              ElementsAre(V(0, 0), V(2, 0), V(0, 2)));
  EXPECT_THAT(
      Coordinates(R"({"index": 0, "extensions": {"KHR_texture_transform": {"texCoord": 1}}})"),
      ElementsAre(V(0, 0), V(2, 0), V(0, 2)));
  EXPECT_THAT(Coordinates(R"({"index": 0, "texCoord": 5})"), IsEmpty());
}

// The extension's own example: only the lower left quadrant of the image, turned clockwise by 90°.
// So the surface's corners (0, 0), (1, 0), (0, 1), top left, top right and bottom left, show the
// quadrant's bottom left, top left and bottom right.
TEST(GltfTextures, TheTransformIsThatOfTheExtensionsExample) {
  const auto uv = Coordinates(
      R"({"index": 0, "extensions": {"KHR_texture_transform":
          {"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5]}}})");
  constexpr float kTolerance = 1e-6f;  // π / 2 has 12 digits; single precision.
  ASSERT_EQ(uv.size(), 3u);
  const std::array<glm::vec2, 3> expected = {{{0.0f, 1.0f}, {0.0f, 0.5f}, {0.5f, 1.0f}}};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(uv[i].x, expected[i].x, kTolerance) << i;
    EXPECT_NEAR(uv[i].y, expected[i].y, kTolerance) << i;
  }
}

TEST(GltfTextures, AnEmissiveTextureOnBlackIsTheTexture) {
  const Scene scene =
      ReadDocument(WithTextures(
                       R"({"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]},
          "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 1}})",
                       {{255, 0, 0, 255}, {0, 255, 0, 255}}))
          .scene;
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].texels[0], glm::u8vec4(0, 255, 0, 255));
  EXPECT_EQ(scene.materials[0].emission_rgb, glm::vec3(1.0f));
}

// The mean over the surface, emission · base texture, is what the file's emissive texture has.
TEST(GltfTextures, AnEmissiveTextureBesideAnotherKeepsItsMean) {
  const GltfScene gltf = ReadDocument(WithTextures(
      R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0},
          "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 1}})",
      {{188, 188, 188, 255}, {255, 255, 255, 255}}));
  ASSERT_EQ(gltf.scene.textures.size(), 1u);
  const double base = std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4);
  EXPECT_FLOAT_EQ(gltf.scene.materials[0].emission_rgb.r, static_cast<float>(1.0 / base));
  EXPECT_THAT(gltf.notes, ElementsAre(HasSubstr("the emission has its right mean")));
}

TEST(GltfTextures, VertexColoursOfAllFormatsAreRead) {
  json document = testing::TriangleDocument();
  document["buffers"].push_back(
      {{"byteLength", 12},
       {"uri", testing::DataUriOf<uint8_t>({255, 0, 51, 255, 0, 0, 0, 255, 255, 255, 255, 255})}});
  document["bufferViews"].push_back({{"buffer", 2}, {"byteLength", 12}});
  document["accessors"].push_back({{"bufferView", 2},
                                   {"componentType", 5121},
                                   {"count", 3},
                                   {"type", "VEC4"},
                                   {"normalized", true}});
  document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 2;
  EXPECT_THAT(ReadDocument(document).scene.meshes.at(0).colors,
              ElementsAre(glm::vec3(1, 0, 0.2f), glm::vec3(0), glm::vec3(1)));
}

}  // namespace
}  // namespace fenestra
