#include "scenes/mesh/tessellation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <tuple>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

using Point = std::tuple<float, float, float>;

Point PointOf(const glm::vec3& p) {
  return {p.x, p.y, p.z};
}

// A tetrahedron of uneven sides whose faces are two meshes.
Scene Tetrahedron() {
  const std::vector<glm::vec3> corners = {
      {0, 0, 0}, {3.1f, 0, 0.3f}, {0.7f, 1.3f, 0}, {0.2f, 0.4f, 2.2f}};
  Scene scene;
  scene.materials = {{.name = "grey"}};
  scene.meshes.push_back(
      {.name = "two", .positions_W = corners, .triangles = {{0, 2, 1}, {0, 1, 3}}});
  scene.meshes.push_back(
      {.name = "other", .positions_W = corners, .triangles = {{1, 2, 3}, {0, 3, 2}}});
  return scene;
}

// How often each directed edge occurs, by its ends' places.
std::map<std::pair<Point, Point>, int> DirectedEdges(const Scene& scene) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const Mesh& mesh : scene.meshes) {
    for (const glm::uvec3& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        ++edges[{PointOf(mesh.positions_W[t[k]]), PointOf(mesh.positions_W[t[(k + 1) % 3]])}];
      }
    }
  }
  return edges;
}

double Area(const Scene& scene) {
  double area = 0.0;
  for (const Mesh& mesh : scene.meshes) {
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a = mesh.positions_W[t.x];
      area += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions_W[t.y]) - a,
                                           glm::dvec3(mesh.positions_W[t.z]) - a));
    }
  }
  return area;
}

TEST(Tessellation, LeavesNoCracksAndNoLongEdges) {
  const Scene scene = Tessellated(Tetrahedron(), 0.21);
  const auto edges = DirectedEdges(scene);
  EXPECT_GT(edges.size(), 500u);
  for (const auto& [edge, count] : edges) {
    const auto& [a, b] = edge;
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({b, a}));  // Its neighbour has the very same edge.
    const double length =
        std::hypot(std::get<0>(a) - std::get<0>(b), std::get<1>(a) - std::get<1>(b),
                   std::get<2>(a) - std::get<2>(b));
    EXPECT_LE(length, 0.21 * (1.0 + 1e-6));
  }
  EXPECT_NEAR(Area(scene), Area(Tetrahedron()), 1e-5);
}

TEST(Tessellation, InterpolatesWhatVerticesCarry) {
  Scene scene = Tetrahedron();
  Mesh& mesh = scene.meshes[0];
  for (const glm::vec3& p : mesh.positions_W) {
    mesh.texture_coordinates.emplace_back(2.0f * p.x, p.y - p.z);
    mesh.colors.emplace_back(0.1f * p.x, 0.2f * p.y, 0.1f);
    mesh.normals_W.push_back(glm::normalize(glm::vec3(1.0f, p.x, 0.0f)));
  }
  const Scene fine = Tessellated(scene, 0.3);
  const Mesh& result = fine.meshes[0];
  ASSERT_EQ(result.texture_coordinates.size(), result.positions_W.size());
  for (size_t i = 0; i < result.positions_W.size(); ++i) {
    const glm::vec3& p = result.positions_W[i];
    EXPECT_NEAR(result.texture_coordinates[i].x, 2.0f * p.x, 1e-5f);
    EXPECT_NEAR(result.texture_coordinates[i].y, p.y - p.z, 1e-5f);
    EXPECT_NEAR(result.colors[i].r, 0.1f * p.x, 1e-6f);
    EXPECT_NEAR(glm::length(result.normals_W[i]), 1.0f, 1e-6f);
  }
  EXPECT_TRUE(fine.meshes[1].colors.empty());
  Validate(fine);
}

TEST(Tessellation, LeavesSolidsAlone) {
  Scene scene = Tetrahedron();
  scene.meshes[0].closed = true;
  const Scene fine = Tessellated(scene, 0.3);
  EXPECT_EQ(fine.meshes[0].triangles.size(), 2u);
  EXPECT_GT(fine.meshes[1].triangles.size(), 100u);
}

TEST(Tessellation, MakesAboutAsManyTrianglesAsAskedFor) {
  for (const size_t triangles : {100u, 1000u, 20000u}) {
    const Scene fine = Tessellated(Tetrahedron(), EdgeForTriangles(Tetrahedron(), triangles));
    const size_t count = fine.meshes[0].triangles.size() + fine.meshes[1].triangles.size();
    EXPECT_GT(count, triangles / 3);
    EXPECT_LT(count, triangles * 3);
  }
  EXPECT_TRUE(std::isinf(EdgeForTriangles(Tetrahedron(), 4)));
  EXPECT_THROW(Tessellated(Tetrahedron(), 0.0), InputError);
  EXPECT_THROW(Tessellated(Tetrahedron(), std::numeric_limits<double>::quiet_NaN()), InputError);
}

}  // namespace
}  // namespace fenestra
