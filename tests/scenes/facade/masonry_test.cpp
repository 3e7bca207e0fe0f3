#include "scenes/facade/masonry.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/scenes/facade/facade_examples.h"
#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

// All meshes that are built from one lattice.
std::vector<Mesh> MasonryOf(const Scene& scene) {
  std::vector<Mesh> meshes;
  for (const char* name :
       {"wall", "frame", "room", "sill", "lintel", "other frame", "other room"}) {
    if (const Mesh* mesh = Find(scene, name)) meshes.push_back(*mesh);
  }
  return meshes;
}

// Counts open edges that are not on the wall's outer edge, where its unseen sides are left out.
int OpenEdges(const std::vector<Mesh>& meshes, const WallOptions& wall) {
  int open = 0;
  const auto x = static_cast<float>(0.5 * wall.width_m);
  const auto y = static_cast<float>(0.5 * wall.height_m);
  for (const auto& [edge, balance] : EdgeBalance(meshes)) {
    const auto& [a, b] = edge;
    const bool on_outer_edge = (std::abs(a[0]) == x && std::abs(b[0]) == x) ||
                               (std::abs(a[1]) == y && std::abs(b[1]) == y);
    if (balance != 0 && !on_outer_edge) ++open;
  }
  return open;
}

TEST(Masonry, HasNoCrackAndNoTJunction) {
  const FacadeOptions plain;
  for (const FacadeOptions& o : {plain, StreetFacade()}) {
    std::vector<Mesh> meshes = MasonryOf(MakeFacade(o));
    EXPECT_EQ(OpenEdges(meshes, o.wall), 0);
    meshes.front().triangles.pop_back();  // The twin: one triangle is missing.
    EXPECT_GT(OpenEdges(meshes, o.wall), 0);
  }
}

TEST(Masonry, FrontsDivideTheWallExactly) {
  FacadeOptions o = StreetFacade();
  o.lintel.projection_m = 0.0;
  const Scene scene = MakeFacade(o);
  const double lintels = 9.0 * (1.0 + 2.0 * o.lintel.overhang_m) * o.lintel.height_m;
  const double sills = 9.0 * (1.0 + 2.0 * o.sill.overhang_m) * o.sill.thickness_m;
  // Areas are sums of some thousand products of single-precision coordinates below 10 m.
  EXPECT_NEAR(AreaInPlane(*Find(scene, "lintel"), 0.0), lintels, 1e-5);
  EXPECT_NEAR(AreaInPlane(*Find(scene, "sill"), o.sill.projection_m), sills, 1e-5);
  EXPECT_NEAR(AreaInPlane(*Find(scene, "wall"), 0.0), 12.0 * 8.0 - 9.0 - lintels - sills, 1e-4);
}

TEST(Masonry, MullionsDivideTheHoleIntoEqualParts) {
  const FacadeOptions o = StreetFacade();
  const Scene scene = MakeFacade(o);
  const double ring = 1.0 - 0.8 * 0.8;
  const double bars = 0.04 * 0.8 + 2.0 * 0.04 * 0.8 - 2.0 * 0.04 * 0.04;  // Crossings count once.
  EXPECT_NEAR(AreaInPlane(*Find(scene, "frame"), -0.1), ring + bars, 1e-5);
  EXPECT_NEAR(AreaInPlane(*Find(scene, "other frame"), -0.1), 8.0 * (ring + bars), 1e-4);
}

TEST(Masonry, RoomsAreApartFromEachOther) {
  const FacadePlan plan = PlanFacade(StreetFacade(), RandomStream(1));
  ASSERT_EQ(plan.windows.size(), 9u);
  for (const WindowPlan& a : plan.windows) {
    for (const WindowPlan& b : plan.windows) {
      if (&a == &b) continue;
      const Eigen::Array3d gap = (a.room_shell.low.cwiseMax(b.room_shell.low) -
                                  a.room_shell.high.cwiseMin(b.room_shell.high))
                                     .array();
      EXPECT_GE(gap.maxCoeff(), -1e-12);  // Rounding; two shells touch.
    }
  }
}

// The lattice cuts faces where parts meet, and nowhere else.
TEST(Masonry, HasNoMoreTrianglesThanItsPartsNeed) {
  FacadeOptions grid;
  grid.window.setback_m = 0.1;
  grid.grid = {.windows_left = 1, .windows_right = 1, .windows_above = 1, .windows_below = 1};
  const auto count = [](const FacadeOptions& options) {
    size_t triangles = 0;
    for (const Mesh& mesh : MakeFacade(options).meshes) triangles += mesh.triangles.size();
    return triangles;
  };
  EXPECT_LT(count(grid), 5'000u);
  EXPECT_LT(count({}), 500u);
}

}  // namespace
}  // namespace fenestra
