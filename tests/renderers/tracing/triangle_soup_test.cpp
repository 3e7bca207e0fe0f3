#include "renderers/tracing/triangle_soup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>
#include <vector>

#include "scenes/mesh/solid_bodies.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

// A wall, a pane before it, and a plate with a hole in its texture.
Scene ThreeKinds() {
  Scene scene;
  scene.materials = {Grey(0.5f), Grey(0.5f), Grey(0.5f)};
  scene.materials[1].kind = Material::Kind::kGlass;
  scene.materials[2].texture = 0;
  scene.materials[2].alpha_cutoff = 0.5f;
  scene.textures = {
      {.name = "hole", .width_px = 1, .height_px = 1, .texels = {{255, 255, 255, 0}}}};
  scene.meshes = {UprightRectangle(-1, -1, 1, 1, 2.0f, 2), UprightRectangle(-1, -1, 1, 1, 1.0f, 1),
                  UprightRectangle(-1, -1, 1, 1, 0.0f, 0)};
  scene.meshes[0].texture_coordinates.assign(4, {0.0f, 0.0f});
  return scene;
}

TEST(TriangleSoup, HoldsTheTrianglesOfOneKindThoseWithHolesLast) {
  const Scene scene = ThreeKinds();
  const TriangleSoup opaque = MakeTriangleSoup(scene, Material::Kind::kLambert);
  ASSERT_EQ(opaque.size(), 4u);
  EXPECT_EQ(opaque.solid_count, 2u);
  EXPECT_EQ(opaque.mesh_of, (std::vector<uint32_t>{2, 2, 0, 0}));
  const TriangleSoup panes = MakeTriangleSoup(scene, Material::Kind::kGlass);
  EXPECT_EQ(panes.mesh_of, (std::vector<uint32_t>{1, 1}));
  EXPECT_EQ(panes.solid_count, 2u);
}

TEST(TriangleSoup, NormalsAreUnitAndRightHanded) {
  const TriangleSoup soup = MakeTriangleSoup(ThreeKinds(), Material::Kind::kLambert);
  for (size_t i = 0; i < soup.size(); ++i) EXPECT_EQ(soup.normals_W[i], glm::vec3(0, 0, 1));
}

TEST(TriangleSoup, TrianglesWithoutAreaAreLeftOut) {
  Scene scene = ThreeKinds();
  scene.meshes[2].triangles.push_back({0, 0, 1});
  scene.meshes[2].positions_W.push_back({0, 0, 0});
  scene.meshes[2].positions_W.push_back({0.5f, 0.5f, 0});
  scene.meshes[2].triangles.push_back({0, 4, 5});  // On one line.
  EXPECT_EQ(MakeTriangleSoup(scene, Material::Kind::kLambert).size(), 4u);
}

TEST(TriangleSoup, WhatAMeshDoesNotCarryHasItsNeutralValue) {
  Scene scene = ThreeKinds();
  scene.meshes[0].normals_W.assign(4, {0, 0, 1});
  const TriangleSoup soup = MakeTriangleSoup(scene, Material::Kind::kLambert);
  ASSERT_EQ(soup.texture_coordinates.size(), soup.positions_W.size());
  ASSERT_EQ(soup.colors.size(), soup.positions_W.size());
  const uint32_t of_wall = soup.triangles[0].x;
  EXPECT_EQ(soup.colors[of_wall], glm::vec3(1.0f));
  EXPECT_EQ(soup.texture_coordinates[of_wall], glm::vec2(0.0f));
  EXPECT_FALSE(soup.is_smooth(0));
  EXPECT_TRUE(soup.is_smooth(2));
}

TEST(TriangleSoup, FrontsHaveEvenNumbersAndSkyAndGroundFollowTheLast) {
  EXPECT_EQ(SideIndex(3, true), 6u);
  EXPECT_EQ(SideIndex(3, false), 7u);
}

size_t SurfacesOf(const Scene& scene) {
  const std::vector<uint32_t> numbers =
      NumberSurfaces(MakeTriangleSoup(scene, Material::Kind::kLambert));
  return std::set<uint32_t>(numbers.begin(), numbers.end()).size();
}

Scene Of(std::vector<Mesh> meshes) {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = std::move(meshes);
  return scene;
}

// Two rectangles that meet at x = 0, the second one turned back by an angle.
Mesh Folded(float angle) {
  const glm::vec3 far(std::cos(angle), 0.0f, -std::sin(angle));
  Mesh mesh{
      .name = "folded",
      .positions_W = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, far, far + glm::vec3(0, 1, 0)},
      .triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}},
      .material = 0};
  return mesh;
}

TEST(TriangleSoup, TrianglesOfOnePlaneAreOneSurface) {
  EXPECT_EQ(SurfacesOf(Of({UprightRectangle(-1, -1, 1, 1, 0.0f, 0)})), 1u);
  EXPECT_EQ(SurfacesOf(Of({Folded(0.0f)})), 1u);
  EXPECT_EQ(SurfacesOf(Of({Folded(0.1f)})), 2u);
  EXPECT_EQ(SurfacesOf(Of({Folded(1e-5f)})), 1u) << "planes that agree to 1e-4";
}

TEST(TriangleSoup, MeshesAreDifferentSurfacesWhereverTheyAre) {
  EXPECT_EQ(SurfacesOf(Of(
                {UprightRectangle(-1, -1, 0, 1, 0.0f, 0), UprightRectangle(0, -1, 1, 1, 0.0f, 0)})),
            2u);
}

TEST(TriangleSoup, ASmoothFoldIsOneSurface) {
  Mesh smooth = Folded(0.3f);
  const glm::vec3 middle = glm::normalize(glm::vec3(std::sin(0.15f), 0.0f, std::cos(0.15f)));
  smooth.normals_W = {{0, 0, 1}, middle, middle, {0, 0, 1}, middle, middle};
  EXPECT_EQ(SurfacesOf(Of({smooth})), 1u);
}

Mesh Cube(double low, double high, int slices = 1) {
  Mesh mesh{.name = "cube"};
  const Eigen::Vector3d one = Eigen::Vector3d::Ones();
  AddCuboid(CuboidOf({low * one, high * one}), slices, mesh);
  return mesh;
}

Scene SceneOf(const std::vector<Mesh>& meshes) {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = meshes;
  return scene;
}

std::vector<bool> BoundsOf(const Scene& scene) {
  return BoundBodies(MakeTriangleSoup(scene, Material::Kind::kLambert));
}

bool All(const std::vector<bool>& values) {
  return std::ranges::all_of(values, [](bool value) { return value; });
}
bool None(const std::vector<bool>& values) {
  return std::ranges::none_of(values, [](bool value) { return value; });
}

TEST(BoundBodies, HoldsForACubeHoweverItIsCut) {
  EXPECT_TRUE(All(BoundsOf(SceneOf({Cube(-1.0, 1.0)}))));
  EXPECT_TRUE(All(BoundsOf(SceneOf({Cube(-1.0, 1.3, 100)}))));
}

TEST(BoundBodies, HoldsForCubesThatTouchOrPenetrate) {
  EXPECT_TRUE(All(BoundsOf(SceneOf({Cube(-1.0, 1.0), Cube(0.5, 2.0), Cube(1.0, 2.0)}))));
}

TEST(BoundBodies, HoldsForABodyWhoseFacesAreDifferentMeshes) {
  const Mesh cube = Cube(-1.0, 1.0);
  Mesh top = cube;
  Mesh rest = cube;
  top.triangles.resize(2);
  rest.triangles.erase(rest.triangles.begin(), rest.triangles.begin() + 2);
  EXPECT_TRUE(All(BoundsOf(SceneOf({top, rest}))));
  EXPECT_TRUE(None(BoundsOf(SceneOf({rest}))));  // An open box.
}

TEST(BoundBodies, HoldsForNoSheetAndNothingInsideOut) {
  EXPECT_TRUE(None(BoundsOf(SceneOf({UprightRectangle(-1, -1, 1, 1, 0, 0)}))));
  Mesh room = Cube(-1.0, 1.0);
  for (glm::uvec3& t : room.triangles) std::swap(t.y, t.z);
  EXPECT_TRUE(None(BoundsOf(SceneOf({room}))));
}

TEST(BoundBodies, TakesTheWordOfAClosedMesh) {
  Mesh sheet = UprightRectangle(-1, -1, 1, 1, 0, 0);
  sheet.closed = true;
  EXPECT_TRUE(All(BoundsOf(SceneOf({sheet}))));
}

}  // namespace
}  // namespace fenestra
