#include "scenes/mesh/solid_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

constexpr Solid kLatticeStone = 1;

SolidLattice ThreeCubed() {
  const std::vector<float> breaks = {0.0f, 1.0f, 2.0f, 3.0f};
  return SolidLattice({breaks, breaks, breaks});
}

size_t TriangleCount(const SolidSurface& surface, Solid solid) {
  return MeshOf(surface, solid, "", 0).triangles.size();
}

TEST(SolidLattice, SurfaceIsClosedAndFacesOutwards) {
  SolidLattice lattice = ThreeCubed();
  lattice.Fill({{0, 0, 0}, {3, 3, 3}}, kLatticeStone);
  lattice.Fill({{1, 1, 0}, {2, 2, 3}}, kAir);  // A hole right through.
  const Mesh mesh = MeshOf(lattice.Surface(SolidLattice::Faces::kAll), kLatticeStone, "ring", 0);
  EXPECT_TRUE(IsWatertight(mesh));
  // Outward normals make it positive; all coordinates are small integers, so it is exact.
  EXPECT_EQ(EnclosedVolume(mesh), 24.0);
}

TEST(SolidLattice, NoFaceStandsBetweenTwoSolids) {
  SolidLattice lattice = ThreeCubed();
  lattice.Fill({{0, 0, 0}, {1, 1, 1}}, kLatticeStone);
  lattice.Fill({{1, 0, 0}, {2, 1, 1}}, kLatticeStone + 1);
  const SolidSurface surface = lattice.Surface(SolidLattice::Faces::kAll);
  // Five of each cube's six faces, two triangles each.
  EXPECT_EQ(TriangleCount(surface, kLatticeStone), 10u);
  EXPECT_EQ(TriangleCount(surface, kLatticeStone + 1), 10u);
}

TEST(SolidLattice, OfItsBorderTheFrontSurfaceHasOnlyPlusZ) {
  SolidLattice lattice = ThreeCubed();
  lattice.Fill({{0, 0, 0}, {3, 3, 3}}, kLatticeStone);
  const Mesh mesh =
      MeshOf(lattice.Surface(SolidLattice::Faces::kFrontOfLattice), kLatticeStone, "front", 0);
  EXPECT_EQ(mesh.triangles.size(), 18u);
  for (const glm::vec3& p : mesh.positions_W) EXPECT_EQ(p.z, 3.0f);
}

TEST(SolidSurface, MeshesShareVerticesOnlyBetweenFacesThatLookOneWay) {
  SolidLattice lattice = ThreeCubed();
  lattice.Fill({{0, 0, 0}, {3, 3, 3}}, kLatticeStone);
  const Mesh cube = MeshOf(lattice.Surface(SolidLattice::Faces::kAll), kLatticeStone, "cube", 0);
  EXPECT_EQ(cube.positions_W.size(), 6u * 16u);
}

TEST(DistinctBreaks, SortsAndMergesWhatRoundingToldApart) {
  EXPECT_EQ(DistinctBreaks({2.0, 0.0, 0.5, 0.5 + 1e-9}), (std::vector<float>{0.0f, 0.5f, 2.0f}));
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
