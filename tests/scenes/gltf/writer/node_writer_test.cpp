#include "scenes/gltf/writer/node_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/targets/flat_targets.h"

namespace fenestra::gltf {
namespace {

using ::testing::ElementsAre;

tinygltf::Model EmptyModel() {
  tinygltf::Model model;
  model.scenes.emplace_back();
  return model;
}

// M_WN of a node, column by column in the file.
Eigen::Matrix4d MatrixOf(const tinygltf::Node& node) {
  EXPECT_EQ(node.matrix.size(), 16u);
  return Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
}

TEST(NodeWriter, EveryMeshIsARootNodeInItsOrder) {
  Scene scene = MakePaperTarget({});
  Mesh empty = scene.meshes[0];
  empty.name = "empty";
  empty.triangles.clear();
  scene.meshes.insert(scene.meshes.begin() + 1, empty);
  tinygltf::Model model = EmptyModel();
  BufferBuilder buffer(model);
  WriteMeshes(scene, model, buffer);
  ASSERT_EQ(model.nodes.size(), scene.meshes.size() - 1);
  EXPECT_EQ(model.scenes[0].nodes.size(), model.nodes.size());
  size_t next = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.triangles.empty()) continue;
    const tinygltf::Node& node = model.nodes[next];
    EXPECT_EQ(model.scenes[0].nodes[next], static_cast<int>(next));
    EXPECT_EQ(node.name, mesh.name);
    const auto& primitive = model.meshes[static_cast<size_t>(node.mesh)].primitives.at(0);
    EXPECT_EQ(primitive.material, static_cast<int>(mesh.material));
    EXPECT_EQ(model.accessors[static_cast<size_t>(primitive.indices)].count,
              3 * mesh.triangles.size());
    ++next;
  }
}

TEST(NodeWriter, TextureCoordinatesAreWrittenWhereATextureUsesThem) {
  Scene scene = MakePaperTarget({});
  for (Mesh& mesh : scene.meshes) mesh.texture_coordinates.assign(mesh.positions_W.size(), {});
  tinygltf::Model model = EmptyModel();
  BufferBuilder buffer(model);
  WriteMeshes(scene, model, buffer);
  for (const tinygltf::Mesh& mesh : model.meshes) {
    EXPECT_FALSE(mesh.primitives[0].attributes.contains("TEXCOORD_0"));
  }
  scene.materials[scene.meshes[0].material].texture = 0;
  tinygltf::Model textured = EmptyModel();
  BufferBuilder more(textured);
  WriteMeshes(scene, textured, more);
  EXPECT_TRUE(textured.meshes[0].primitives[0].attributes.contains("TEXCOORD_0"));
}

TEST(NodeWriter, WindowsAreNodesWithTheirFrameAndSize) {
  Scene scene;
  const Pose X_WO(RotationFromVector({0.3, -1.1, 0.7}), {0.1, -2.0 / 3.0, 1e-3});
  scene.target = TargetWindow{.X_WO = X_WO, .width_m = 1.1, .height_m = 0.7};
  scene.other_windows = {TargetWindow{.X_WO = Pose(), .width_m = 2.0, .height_m = 1.0}};
  tinygltf::Model model = EmptyModel();
  WriteWindows(scene, model);
  ASSERT_EQ(model.nodes.size(), 2u);
  EXPECT_EQ(model.nodes[0].name, "target_window");
  EXPECT_EQ(model.nodes[1].name, "other_window");
  // A matrix, and no quaternion, which would round.
  EXPECT_EQ((MatrixOf(model.nodes[0]).topLeftCorner<3, 3>()), X_WO.rotation());
  EXPECT_EQ((MatrixOf(model.nodes[0]).topRightCorner<3, 1>()), X_WO.translation());
  const tinygltf::Value& ours = model.nodes[0].extras.Get("fenestra").Get("target_window");
  EXPECT_EQ(ours.Get("width_m").GetNumberAsDouble(), 1.1);
  EXPECT_EQ(ours.Get("height_m").GetNumberAsDouble(), 0.7);
}

// yfov = 2 atan(h/2f); glTF's cameras look along -z with +y up.
TEST(NodeWriter, ACameraIsAFieldOfViewForOtherProgramsAndItsNumbersForOurs) {
  const CameraModel model_of_camera({.width_px = 752,
                                     .height_px = 480,
                                     .fx_px = 667.0,
                                     .fy_px = 668.0,
                                     .cx_px = 370.0,
                                     .cy_px = 241.0,
                                     .distortion = {.k1 = -0.1}});
  const Pose X_WC(RotationFromVector({0.2, 0.4, -0.3}), {1.0, 2.0, 3.0});
  tinygltf::Model model = EmptyModel();
  WriteCameras({{.name = "left", .X_WC = X_WC, .model = model_of_camera}}, model);
  const auto& perspective = model.cameras.at(0).perspective;
  EXPECT_NEAR(std::tan(0.5 * perspective.yfov), 240.0 / 668.0, 1e-12);
  EXPECT_NEAR(std::tan(0.5 * perspective.yfov) * perspective.aspectRatio, 376.0 / 667.0, 1e-12);
  const Eigen::Matrix4d M_WG = MatrixOf(model.nodes.at(0));
  const Eigen::Vector3d looks = M_WG.topLeftCorner<3, 3>() * -Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d up = M_WG.topLeftCorner<3, 3>() * Eigen::Vector3d::UnitY();
  EXPECT_EQ(looks, X_WC.rotation().col(2));
  EXPECT_EQ(up, -X_WC.rotation().col(1));
  const tinygltf::Value& ours = model.cameras[0].extras.Get("fenestra");
  EXPECT_EQ(ours.Get("cx_px").GetNumberAsDouble(), 370.0);
  EXPECT_EQ(ours.Get("distortion").Get(0).GetNumberAsDouble(), -0.1);
}

TEST(NodeWriter, TheSunIsADirectionalLightThatShinesAlongMinusZ) {
  GltfScene scene;
  scene.sun = Sun{.azimuth_rad = 0.4, .elevation_rad = 0.7, .illuminance_lx = 6e4};
  tinygltf::Model model = EmptyModel();
  WriteLights(scene, model);
  ASSERT_EQ(model.lights.size(), 1u);
  EXPECT_EQ(model.lights[0].type, "directional");
  EXPECT_EQ(model.lights[0].intensity, 6e4);
  const Eigen::Matrix3d R_WN = MatrixOf(model.nodes.at(0)).topLeftCorner<3, 3>();
  EXPECT_LT((R_WN.col(2) - scene.sun->Direction_W()).norm(), 1e-15);
  EXPECT_NEAR(R_WN.determinant(), 1.0, 1e-12);
}

TEST(NodeWriter, LampsArePointsOrSpotsOfTheirIntensity) {
  GltfScene scene;
  scene.scene.lamps = {
      {.name = "bulb", .p_WL = {1.0, 2.0, 3.0}, .intensity_rgb = {100.0f, 50.0f, 25.0f}},
      {.name = "spot", .p_WL = {0.0, 1.0, 0.0}, .intensity_rgb = glm::vec3(7.0f)}};
  scene.scene.lamps[1].cone =
      Lamp::Cone{.axis_W = -Eigen::Vector3d::UnitY(), .inner_rad = 0.2, .outer_rad = 0.5};
  tinygltf::Model model = EmptyModel();
  WriteLights(scene, model);
  ASSERT_EQ(model.lights.size(), 2u);
  EXPECT_EQ(model.lights[0].type, "point");
  EXPECT_THAT(model.nodes[0].translation, ElementsAre(1.0, 2.0, 3.0));
  // Colour times intensity.
  EXPECT_EQ(model.lights[0].intensity * model.lights[0].color[1], 50.0);
  EXPECT_LE(model.lights[0].color[0], 1.0);
  EXPECT_EQ(model.lights[1].type, "spot");
  EXPECT_EQ(model.lights[1].spot.outerConeAngle, 0.5);
  // A spot shines along -z.
  const Eigen::Matrix3d R_WN = MatrixOf(model.nodes[1]).topLeftCorner<3, 3>();
  EXPECT_EQ(Eigen::Vector3d(-R_WN.col(2)), scene.scene.lamps[1].cone->axis_W);
}

}  // namespace
}  // namespace fenestra::gltf
