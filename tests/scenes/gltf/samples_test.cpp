#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scenes/gltf/gltf.h"
#include "scenes/gltf/reader/gltf_reader.h"
#include "tests/scenes/gltf/gltf_text.h"

// What the Khronos sample models are, by their descriptions, against what is read of them.

namespace fenestra {
namespace {

using testing::GltfData;
using ::testing::HasSubstr;
using testing::SignedVolume;

GltfScene ReadSample(const std::string& path) {
  return ReadGltf(GltfData() / "samples" / path);
}

double Area(const Mesh& mesh) {
  double area = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions_W[t.x];
    area += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions_W[t.y]) - a,
                                         glm::dvec3(mesh.positions_W[t.z]) - a));
  }
  return area;
}

TEST(GltfSamples, OneBoxInFourWrappingsIsTheSameUnitCube) {
  for (const char* file : {"Box/glTF/Box.gltf", "Box/glTF-Embedded/Box.gltf",
                           "Box/glTF-Binary/Box.glb", "BoxInterleaved/glTF/BoxInterleaved.gltf"}) {
    const Scene scene = ReadSample(file).scene;
    ASSERT_EQ(scene.meshes.size(), 1u) << file;
    EXPECT_EQ(scene.meshes[0].triangles.size(), 12u) << file;
    // Coordinates of ±0.5: exact in any order of summation but for the sixths.
    EXPECT_NEAR(SignedVolume(scene.meshes[0]), 1.0, 1e-14) << file;
    EXPECT_NEAR(Area(scene.meshes[0]), 6.0, 1e-14) << file;
    EXPECT_EQ(scene.meshes[0].normals_W.size(), scene.meshes[0].positions_W.size()) << file;
  }
}

TEST(GltfSamples, DracoIsRefusedByName) {
  EXPECT_THAT(testing::Refusal(GltfData() / "samples/Box/glTF-Draco/Box.gltf"),
              HasSubstr("/extensionsRequired/0: the file requires KHR_draco_mesh_compression"));
}

// The description: three points of a flat strip are displaced by the sparse values.
TEST(GltfSamples, SparseValuesReplaceThoseOfTheBuffer) {
  const Scene scene = ReadSample("SimpleSparseAccessor/glTF/SimpleSparseAccessor.gltf").scene;
  const auto& p = scene.meshes.at(0).positions_W;
  ASSERT_EQ(p.size(), 14u);
  EXPECT_EQ(p[8], glm::vec3(1, 2, 0));
  EXPECT_EQ(p[10], glm::vec3(3, 3, 0));
  EXPECT_EQ(p[12], glm::vec3(5, 4, 0));
  EXPECT_EQ(p[9], glm::vec3(2, 1, 0));  // Not among them.
}

TEST(GltfSamples, InstancesStandEachAtItsPlace) {
  const Scene scene = ReadSample("SimpleInstancing/glTF/SimpleInstancing.gltf").scene;
  ASSERT_EQ(scene.meshes.size(), 125u);
  EXPECT_EQ(scene.meshes[0].name, "[0]");
  glm::vec3 high(-1e9f);
  for (const Mesh& mesh : scene.meshes) {
    // A unit cube scaled by 1 to 2 along each axis. Single precision of coordinates up to 12.
    EXPECT_GT(SignedVolume(mesh), 1.0 - 1e-4);
    EXPECT_LT(SignedVolume(mesh), 8.0 + 1e-4);
    for (const glm::vec3& p : mesh.positions_W) high = glm::max(high, p);
  }
  EXPECT_GT(high.x, 10.0f);  // The last one's origin is at (10, 10, 10).
}

// Weights 0.5 and 0.5 of the mesh; targets move the apex (0.5, 1) by (-1, 1) and (1, 1) or so.
TEST(GltfSamples, MorphTargetsAreMixedByTheMeshsWeights) {
  const Scene scene = ReadSample("SimpleMorph/glTF/SimpleMorph.gltf").scene;
  const auto& p = scene.meshes.at(0).positions_W;
  EXPECT_EQ(p[0], glm::vec3(0, 0, 0));
  EXPECT_EQ(p[1], glm::vec3(1, 0, 0));
  EXPECT_EQ(p[2], glm::vec3(0.5f, 1.5f, 0));
}

// In its rest pose the joints stand as they did when they were bound: the strip is as in the file.
TEST(GltfSamples, ASkinAtRestIsAsItWasBound) {
  const Scene scene = ReadSample("SimpleSkin/glTF/SimpleSkin.gltf").scene;
  const auto& p = scene.meshes.at(0).positions_W;
  ASSERT_EQ(p.size(), 10u);
  for (size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(p[i], glm::vec3(i % 2 == 0 ? -0.5f : 0.5f, 0.5f * static_cast<float>(i / 2), 0.0f));
  }
}

TEST(GltfSamples, ListsStripsAndFansFaceTheSameWay) {
  const GltfScene gltf = ReadSample("MeshPrimitiveModes/glTF/MeshPrimitiveModes.gltf");
  ASSERT_EQ(gltf.scene.meshes.size(), 3u);
  for (const Mesh& mesh : gltf.scene.meshes) {
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::vec3 a = mesh.positions_W[t.x];
      EXPECT_GT(glm::cross(mesh.positions_W[t.y] - a, mesh.positions_W[t.z] - a).z, 0.0f)
          << mesh.name;
    }
  }
  EXPECT_THAT(gltf.notes, ::testing::ElementsAre(HasSubstr("points, lines")));
}

TEST(GltfSamples, OneMeshInTwoNodesStandsTwice) {
  const Scene scene = ReadSample("SimpleMeshes/glTF/SimpleMeshes.gltf").scene;
  ASSERT_EQ(scene.meshes.size(), 2u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(scene.meshes[1].positions_W[i], scene.meshes[0].positions_W[i] + glm::vec3(1, 0, 0));
  }
}

TEST(GltfSamples, TheSceneCanBeChosen) {
  const auto file = GltfData() / "samples/MultipleScenes/glTF/MultipleScenes.gltf";
  EXPECT_EQ(ReadGltf(file, {.scene_index = 0}).scene.meshes.at(0).triangles.size(), 1u);
  EXPECT_EQ(ReadGltf(file, {.scene_index = 1}).scene.meshes.at(0).triangles.size(), 2u);
  EXPECT_THAT(testing::Refusal(file, {.scene_index = 2}),
              HasSubstr("scene 2 does not exist; there are 2"));
}

TEST(GltfSamples, EveryModelIsReadButDraco) {
  size_t models = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(GltfData() / "samples")) {
    const auto extension = entry.path().extension();
    if (extension != ".gltf" && extension != ".glb") continue;
    if (entry.path().string().find("Draco") != std::string::npos) continue;
    EXPECT_EQ(testing::Refusal(entry.path()), "");
    ++models;
  }
  EXPECT_EQ(models, 20u);
}

}  // namespace
}  // namespace fenestra
