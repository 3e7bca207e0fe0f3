#include "scenes/scene.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

Scene OneTriangle() {
  Scene scene;
  scene.materials.push_back({.name = "paint", .reflectance_rgb = glm::vec3(0.5f)});
  scene.meshes.push_back({.name = "triangle",
                          .positions_W = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          .triangles = {{0, 1, 2}}});
  return scene;
}

TEST(Scene, AWellFormedOneIsAccepted) {
  EXPECT_NO_THROW(Validate(OneTriangle()));
}

TEST(Scene, AllFaultsAreReportedAtOnce) {
  Scene scene = OneTriangle();
  scene.materials[0].reflectance_rgb.g = 1.01f;
  scene.materials.push_back(
      {.name = "thin air", .kind = Material::Kind::kGlass, .refractive_index = 0.5f});
  scene.meshes[0].positions_W[1].x = std::numeric_limits<float>::quiet_NaN();
  scene.meshes[0].triangles.push_back({0, 1, 3});
  scene.meshes[0].material = 2;
  scene.target = TargetWindow{.X_WO = Pose(), .width_m = 0.0, .height_m = 1.0};
  try {
    Validate(scene);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 6u) << error.what();
  }
}

TEST(TargetWindow, CornersGoRoundFromTopLeft) {
  const TargetWindow window{
      .X_WO = Pose::Translation({1.0, 2.0, 3.0}), .width_m = 2.0, .height_m = 4.0};
  const auto corners = window.Corners_W();
  EXPECT_EQ(corners[0], Eigen::Vector3d(0.0, 4.0, 3.0));
  EXPECT_EQ(corners[1], Eigen::Vector3d(2.0, 4.0, 3.0));
  EXPECT_EQ(corners[2], Eigen::Vector3d(2.0, 0.0, 3.0));
  EXPECT_EQ(corners[3], Eigen::Vector3d(0.0, 0.0, 3.0));
}

}  // namespace
}  // namespace fenestra
