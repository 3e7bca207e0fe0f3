#include "scenes/mesh/tessellation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

constexpr Solid kStone = 1;
constexpr Solid kWood = 2;

// A block of two solids with a hole, in cells of very different sizes.
SolidSurface TwoSolids() {
  const std::vector<float> breaks = {0.0f, 0.125f, 1.0f, 4.0f};
  SolidLattice lattice({breaks, breaks, breaks});
  lattice.Fill({{0, 0, 0}, {4, 4, 4}}, kStone);
  lattice.Fill({{0, 0, 0}, {1, 1, 4}}, kWood);
  lattice.Fill({{0.125, 0.125, 0}, {1, 1, 4}}, kAir);
  return lattice.Surface(SolidLattice::Faces::kAll);
}

double AllowedAt(const glm::vec3& p) {
  return 0.1 + 0.5 * static_cast<double>(glm::length(p));
}

bool AnyEdgeIsTooLong(const SolidSurface& surface) {
  for (const SolidSurface::Triangle& t : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 a = surface.positions_W[t.corners[k]];
      const glm::vec3 b = surface.positions_W[t.corners[(k + 1) % 3]];
      if (static_cast<double>(glm::distance(a, b)) > AllowedAt(0.5f * (a + b)) + 1e-6) return true;
    }
  }
  return false;
}

TEST(LongestEdgeBisection, LeavesNoLongEdgeAndNoCrackAndKeepsTheBody) {
  SolidSurface surface = TwoSolids();
  EXPECT_TRUE(AnyEdgeIsTooLong(surface));
  BisectLongEdges(surface, AllowedAt);
  EXPECT_FALSE(AnyEdgeIsTooLong(surface));
  const std::vector<Mesh> meshes = {MeshOf(surface, kStone, "stone", 0),
                                    MeshOf(surface, kWood, "wood", 0)};
  for (const auto& [edge, balance] : EdgeBalance(meshes)) EXPECT_EQ(balance, 0);
  // Halving numbers with few binary digits is exact.
  EXPECT_EQ(EnclosedVolume(meshes[0]) + EnclosedVolume(meshes[1]), 64.0 - 4.0 * 0.875 * 0.875);
}

// Where floats are 0.25 m apart, edges of 0.1 m cannot be had.
TEST(LongestEdgeBisection, EndsWhereFloatsAreCoarse) {
  SolidSurface surface = TwoSolids();
  for (glm::vec3& p : surface.positions_W) p += glm::vec3(4e6f);
  BisectLongEdges(surface, [](const glm::vec3&) { return 0.1; });
  EXPECT_LT(surface.triangles.size(), 100000u);
}

TEST(LongestEdgeBisection, DoesNothingWhereNothingIsTooLong) {
  SolidSurface surface = TwoSolids();
  const size_t count = surface.triangles.size();
  BisectLongEdges(surface, [](const glm::vec3&) { return 100.0; });
  EXPECT_EQ(surface.triangles.size(), count);
}

// Rivara (1984): bisecting longest edges at worst halves the smallest angle of a triangle.
TEST(LongestEdgeBisection, AtWorstHalvesTheSmallestAngle) {
  SolidLattice lattice({std::vector<float>{0.0f, 1.0f}, {0.0f, 1.0f}, {0.0f, 1.0f}});
  lattice.Fill({{0, 0, 0}, {1, 1, 1}}, kStone);
  SolidSurface surface = lattice.Surface(SolidLattice::Faces::kAll);
  BisectLongEdges(surface, AllowedAt);
  for (const SolidSurface::Triangle& t : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 a = surface.positions_W[t.corners[k]];
      const glm::vec3 b = surface.positions_W[t.corners[(k + 1) % 3]];
      const glm::vec3 c = surface.positions_W[t.corners[(k + 2) % 3]];
      const float cosine = glm::dot(glm::normalize(b - a), glm::normalize(c - a));
      EXPECT_LT(cosine, std::cos(0.5f * 0.785398f) + 1e-5f);
    }
  }
}

}  // namespace
}  // namespace fenestra
