#include "scenes/mesh/tessellation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <tuple>

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

size_t TriangleCount(const Scene& scene) {
  size_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += mesh.triangles.size();
  return count;
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
  constexpr size_t kTriangles = 1000;
  const Scene scene = Tessellated(Tetrahedron(), kTriangles);
  // Longest-edge bisection keeps shapes: no edge is far longer than that of a half square of the
  // mean area, whose square is four times the area.
  const double longest_m = 2.0 * std::sqrt(4.0 * Area(scene) / kTriangles);
  const auto edges = DirectedEdges(scene);
  EXPECT_GT(edges.size(), 500u);
  for (const auto& [edge, count] : edges) {
    const auto& [a, b] = edge;
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({b, a}));  // Its neighbour has the very same edge.
    const double length =
        std::hypot(std::get<0>(a) - std::get<0>(b), std::get<1>(a) - std::get<1>(b),
                   std::get<2>(a) - std::get<2>(b));
    EXPECT_LE(length, longest_m);
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
  const Scene fine = Tessellated(scene, 400);
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
  const Scene fine = Tessellated(scene, 400);
  EXPECT_EQ(fine.meshes[0].triangles.size(), 2u);
  EXPECT_GT(fine.meshes[1].triangles.size(), 100u);
}

TEST(Tessellation, MakesAsManyTrianglesAsAskedFor) {
  for (const size_t triangles : {5u, 100u, 1000u, 20000u}) {
    const size_t count = TriangleCount(Tessellated(Tetrahedron(), triangles));
    EXPECT_GE(count, triangles);
    EXPECT_LT(count, 2 * triangles);
  }
  EXPECT_EQ(TriangleCount(Tessellated(Tetrahedron(), 4)), 4u);
  EXPECT_EQ(TriangleCount(Tessellated(Tetrahedron(), 0)), 4u);
}

// At 4e6 m floats are 0.25 m or 0.5 m apart: halving ends where neighbours are reached.
TEST(Tessellation, EndsWhereFloatsAreCoarse) {
  Scene far = Tetrahedron();
  for (Mesh& mesh : far.meshes) {
    for (glm::vec3& p : mesh.positions_W) p += glm::vec3(-4649776.0f, 0.0f, 3904000.0f);
  }
  const Scene fine = Tessellated(far, 20000);
  EXPECT_GT(TriangleCount(fine), 4u);
  EXPECT_LT(TriangleCount(fine), 2u * 20000u);
}

TEST(Tessellation, EndsForTrianglesOfAnyShape) {
  const float largest = std::numeric_limits<float>::max();
  const float smallest = std::numeric_limits<float>::denorm_min();
  const std::vector<std::vector<glm::vec3>> shapes = {
      {{0, 0, 0}, {1e6f, 0, 0}, {0, 1e-6f, 0}},              // A needle.
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},                     // A line,
      {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}},                     // a point,
      {{-largest, 0, 0}, {largest, 0, 0}, {0, largest, 0}},  // the largest
      {{0, 0, 0}, {smallest, 0, 0}, {0, smallest, 0}},       // and the smallest there is.
      {{1, 0, 0}, {std::nextafter(1.0f, 2.0f), 0, 0}, {1, 1e-30f, 0}},  // Neighbours.
  };
  for (size_t i = 0; i < shapes.size(); ++i) {
    Scene scene;
    scene.materials = {{.name = "grey"}};
    scene.meshes.push_back({.name = "one", .positions_W = shapes[i], .triangles = {{0, 1, 2}}});
    const Scene fine = Tessellated(scene, 1000);
    EXPECT_LE(TriangleCount(fine), 2000u) << "shape " << i;
    Validate(fine);
  }
}

}  // namespace
}  // namespace fenestra
