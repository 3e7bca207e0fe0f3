#include "scenes/mesh/solid_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/geometry/pose.h"
#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

// Sums of products of single-precision coordinates of about 1 m.
constexpr double kVolumeTolerance = 1e-6;

Mesh Closed() {
  return {.name = "body", .closed = true};
}

TEST(Cuboid, IsClosedFacesOutwardsAndHasItsVolume) {
  const Eigen::Matrix3d R = RotationFromVector({0.3, -0.5, 0.8});
  for (const int slices : {1, 5}) {
    Mesh mesh = Closed();
    AddCuboid({.centre_W = {0.1, 0.2, 0.3},
               .half_x = R * Vector3d(0.5, 0, 0),
               .half_y = R * Vector3d(0, 0.3, 0),
               .half_z = R * Vector3d(0, 0, 0.01)},
              slices, mesh);
    if (slices == 1) {
      EXPECT_TRUE(IsWatertight(mesh));
    }
    EXPECT_NEAR(EnclosedVolume(mesh), 8.0 * 0.5 * 0.3 * 0.01, kVolumeTolerance);
    for (const glm::vec3& p : mesh.positions_W) {
      const Vector3d in_cuboid =
          R.transpose() * (Vector3d(p.x, p.y, p.z) - Vector3d(0.1, 0.2, 0.3));
      EXPECT_NEAR(std::abs(in_cuboid.x()), 0.5, 1e-6);
      EXPECT_NEAR(std::abs(in_cuboid.z()), 0.01, 1e-6);
    }
  }
}

TEST(Cuboid, CutInSlicesIsStillClosed) {
  Mesh mesh = Closed();
  AddCuboid(CuboidOf({{0.1, 0.2, 0.3}, {1.3, 2.4, 0.5}}), 7, mesh);
  EXPECT_TRUE(IsWatertight(mesh));
  mesh.triangles.pop_back();
  EXPECT_FALSE(IsWatertight(mesh));
}

// A prism of n sides has the cross-section n/2 r² sin(2π/n).
TEST(Bar, IsAClosedPrismWithTheNormalsOfARoundOne) {
  constexpr int kSides = 16;
  Mesh mesh = Closed();
  AddBar({{0.3, -1.0, 0.2}, {0.3, 0.5, 0.2}, {0.3, 1.0, 0.2}}, 0.05, kSides, mesh);
  EXPECT_TRUE(IsWatertight(mesh));
  const double section = 0.5 * kSides * 0.05 * 0.05 * std::sin(2.0 * std::numbers::pi / kSides);
  EXPECT_NEAR(EnclosedVolume(mesh), 2.0 * section, kVolumeTolerance);
  ASSERT_EQ(mesh.normals_W.size(), mesh.positions_W.size());
  for (size_t i = 0; i < mesh.positions_W.size(); ++i) {
    const glm::vec3& n = mesh.normals_W[i];
    EXPECT_NEAR(glm::length(n), 1.0f, 1e-6f);
    if (n.y != 0.0f) continue;  // An end.
    const glm::vec3 axis(0.3f, mesh.positions_W[i].y, 0.2f);
    EXPECT_LT(glm::distance(axis + 0.05f * n, mesh.positions_W[i]), 1e-6f);
  }
}

TEST(Bar, AlongACurveStaysClosed) {
  std::vector<Vector3d> path;
  for (int i = -5; i <= 5; ++i) path.emplace_back(0.4 * i, 0.01 * i * i, 0.2);
  Mesh mesh = Closed();
  AddBar(path, 0.02, 6, mesh);
  EXPECT_TRUE(IsWatertight(mesh));
  EXPECT_GT(EnclosedVolume(mesh), 0.0);
}

}  // namespace
}  // namespace fenestra
