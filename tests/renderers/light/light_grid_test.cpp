#include "renderers/light/light_grid.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

#include "renderers/tracing/triangle_soup.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

// The patch of a rectangle of two triangles.
LightPatches RectanglePatches() {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = {UprightRectangle(-1.0f, -0.5f, 1.0f, 0.5f, 0.0f, 0)};
  const TriangleSoup soup = MakeTriangleSoup(scene, Material::Kind::kLambert);
  return LightPatches(soup, NumberSurfaces(soup));
}

LightGrid RandomlyHalved(const LightPatches& patches, int times) {
  LightGrid grid(patches, 0, 1, 0);
  std::mt19937 random(7);
  for (int i = 0; i < times; ++i) {
    const std::vector<size_t> leaves = grid.UsedLeaves();
    const size_t leaf = leaves[random() % leaves.size()];
    if (grid.cells()[leaf].can_be_halved()) grid.Halve(leaf);
  }
  return grid;
}

// No corner of a leaf is the middle of another's edge, so that what is interpolated has no steps.
TEST(LightGrid, HasNoHangingNodesHoweverItIsHalved) {
  const LightPatches patches = RectanglePatches();
  const LightGrid grid = RandomlyHalved(patches, 300);
  std::set<std::pair<int32_t, int32_t>> nodes;
  for (const size_t leaf : grid.UsedLeaves()) {
    for (const GridNode& n : grid.cells()[leaf].corners) nodes.emplace(n.s, n.t);
  }
  EXPECT_GT(nodes.size(), 200u);
  for (const size_t leaf : grid.UsedLeaves()) {
    const auto& c = grid.cells()[leaf].corners;
    for (size_t k = 0; k < 3; ++k) {
      const GridNode& a = c[k];
      const GridNode& b = c[(k + 1) % 3];
      EXPECT_FALSE(nodes.contains({(a.s + b.s) / 2, (a.t + b.t) / 2}));
    }
  }
}

TEST(LightGrid, FindsTheLeafThatContainsAPoint) {
  const LightPatches patches = RectanglePatches();
  const LightGrid grid = RandomlyHalved(patches, 300);
  std::mt19937 random(8);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec2 st(unit(random), unit(random));
    const auto& c = grid.cells()[grid.Find(st)].corners;
    EXPECT_TRUE(Contains({InPatch(c[0]), InPatch(c[1]), InPatch(c[2])}, st)) << st.x << " " << st.y;
  }
}

TEST(LightLeaves, InterpolateALinearFunctionExactly) {
  const LightPatches patches = RectanglePatches();
  const LightGrid grid = RandomlyHalved(patches, 100);
  std::vector<LightLeaves::Leaf> of_grid;
  for (const size_t leaf : grid.UsedLeaves()) {
    LightLeaves::Leaf& added = of_grid.emplace_back();
    for (size_t k = 0; k < 3; ++k) added.corners[k] = InPatch(grid.cells()[leaf].corners[k]);
  }
  LightLeaves leaves(patches.face_count());
  leaves.Add(0, grid, of_grid);
  EXPECT_EQ(leaves.Find(1, {0.5f, 0.5f}), LightLeaves::kNone);
  const auto light = [](const glm::vec2& st) { return 3.0f - 2.0f * st.x + 0.5f * st.y; };
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (int i = 0; i < 1000; ++i) {
    const glm::vec2 st(unit(random), unit(random));
    const uint32_t index = leaves.Find(0, st);
    EXPECT_TRUE(leaves.IsIn(index, st));
    const LightLeaves::Leaf& leaf = leaves.leaves()[index];
    const auto c =
        leaf.Interpolate({light(leaf.corners[0]), light(leaf.corners[1]), light(leaf.corners[2])});
    EXPECT_NEAR(c[0] + c[1] * st.x + c[2] * st.y, light(st), 1e-4f);
  }
}

}  // namespace
}  // namespace fenestra
