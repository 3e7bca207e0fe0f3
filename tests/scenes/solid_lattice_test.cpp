#include "scenes/solid_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>

namespace fenestra {
namespace {

constexpr SolidLattice::Solid kStone = 1;

SolidLattice ThreeCubed() {
  const std::vector<float> breaks = {0.0f, 1.0f, 2.0f, 3.0f};
  return SolidLattice({breaks, breaks, breaks});
}

using Corner = std::array<float, 3>;

Corner At(const Mesh& mesh, uint32_t index) {
  const glm::vec3& p = mesh.positions_W[index];
  return {p.x, p.y, p.z};
}

// How often each edge, found by its positions, is walked forward minus backward.
std::map<std::pair<Corner, Corner>, int> EdgeBalance(const Mesh& mesh) {
  std::map<std::pair<Corner, Corner>, int> balance;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Corner a = At(mesh, t[k]);
      const Corner b = At(mesh, t[(k + 1) % 3]);
      if (a < b) {
        ++balance[{a, b}];
      } else {
        --balance[{b, a}];
      }
    }
  }
  return balance;
}

double EnclosedVolume(const Mesh& mesh) {
  double six_volumes = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    six_volumes +=
        glm::dot(glm::dvec3(mesh.positions_W[t.x]),
                 glm::cross(glm::dvec3(mesh.positions_W[t.y]), glm::dvec3(mesh.positions_W[t.z])));
  }
  return six_volumes / 6.0;
}

TEST(SolidLattice, SurfaceIsClosedAndFacesOutwards) {
  SolidLattice lattice = ThreeCubed();
  lattice.Fill({{0, 0, 0}, {3, 3, 3}}, kStone);
  lattice.Fill({{1, 1, 0}, {2, 2, 3}}, SolidLattice::kAir);  // A hole right through.
  const Mesh mesh = lattice.Surface(kStone, SolidLattice::Faces::kAll, "ring", 0);
  for (const auto& [edge, balance] : EdgeBalance(mesh)) EXPECT_EQ(balance, 0);
  // Outward normals make it positive; all coordinates are small integers, so it is exact.
  EXPECT_EQ(EnclosedVolume(mesh), 24.0);
}

TEST(SolidLattice, NoFaceStandsBetweenTwoSolids) {
  SolidLattice lattice = ThreeCubed();
  lattice.Fill({{0, 0, 0}, {1, 1, 1}}, kStone);
  lattice.Fill({{1, 0, 0}, {2, 1, 1}}, kStone + 1);
  // Five of each cube's six faces, two triangles each.
  EXPECT_EQ(lattice.Surface(kStone, SolidLattice::Faces::kAll, "a", 0).triangles.size(), 10u);
  EXPECT_EQ(lattice.Surface(kStone + 1, SolidLattice::Faces::kAll, "b", 0).triangles.size(), 10u);
}

TEST(SolidLattice, OfItsBorderTheFrontSurfaceHasOnlyPlusZ) {
  SolidLattice lattice = ThreeCubed();
  lattice.Fill({{0, 0, 0}, {3, 3, 3}}, kStone);
  const Mesh mesh = lattice.Surface(kStone, SolidLattice::Faces::kFrontOfLattice, "front", 0);
  EXPECT_EQ(mesh.triangles.size(), 18u);
  for (const glm::vec3& p : mesh.positions_W) EXPECT_EQ(p.z, 3.0f);
}

TEST(GradedBreaks, KeepsFixedCoordinatesAndCellSize) {
  const std::vector<float> breaks =
      GradedBreaks({2.0, 0.0, 0.5, 0.5 + 1e-9}, [](double) { return 0.3; });
  EXPECT_TRUE(std::ranges::is_sorted(breaks, std::less_equal<>{}));
  for (const float fixed : {0.0f, 0.5f, 2.0f}) {
    EXPECT_EQ(std::ranges::count(breaks, fixed), 1) << fixed;
  }
  for (size_t i = 1; i < breaks.size(); ++i) EXPECT_LE(breaks[i] - breaks[i - 1], 0.3f);
}

}  // namespace
}  // namespace fenestra
