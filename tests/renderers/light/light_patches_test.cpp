#include "renderers/light/light_patches.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scenes/facade/facade.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

TEST(LightPatches, HoldEachTriangleWhereItIs) {
  const Scene scene = MakeFacade({.window = {.setback_m = 0.1}});
  const TriangleSoup soup = MakeTriangleSoup(scene, Material::Kind::kLambert);
  const LightPatches patches(soup, NumberSurfaces(soup));
  EXPECT_LT(patches.patches().size(), soup.size() / 5);
  for (uint32_t t = 0; t < soup.size(); ++t) {
    const LightPatch& patch = patches.patches()[patches.PatchOf(t)];
    for (int k = 0; k < 3; ++k) {
      const glm::vec2 st = patches.InPatch(t)[static_cast<size_t>(k)];
      // Some roundings of metres.
      EXPECT_LT(glm::distance(patch.At(st), soup.positions_W[soup.triangles[t][k]]), 1e-5f);
    }
    EXPECT_GT(glm::dot(patch.n_W, soup.normals_W[t]), 0.9999f);
  }
}

TEST(LightPatches, ThatDoNotTouchAreApart) {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  Mesh two = UprightRectangle(-1.0f, -1.0f, -0.5f, 1.0f, 0.0f, 0);
  const Mesh other = UprightRectangle(0.5f, -1.0f, 1.0f, 1.0f, 0.0f, 0);
  const auto base = static_cast<uint32_t>(two.positions_W.size());
  two.positions_W.insert(two.positions_W.end(), other.positions_W.begin(), other.positions_W.end());
  for (const glm::uvec3& t : other.triangles) two.triangles.push_back(t + base);
  scene.meshes = {two};
  const TriangleSoup soup = MakeTriangleSoup(scene, Material::Kind::kLambert);
  EXPECT_EQ(LightPatches(soup, NumberSurfaces(soup)).patches().size(), 2u);
}

TEST(PatchTriangles, OverlapUnlessALineSeparatesThem) {
  const PatchTriangle a = {glm::vec2(0, 0), {1, 0}, {0, 1}};
  EXPECT_TRUE(Overlap(a, {glm::vec2(0.2f, 0.2f), {0.3f, 0.2f}, {0.2f, 0.3f}}));
  EXPECT_TRUE(Overlap({glm::vec2(0.2f, 0.2f), {0.3f, 0.2f}, {0.2f, 0.3f}}, a));
  EXPECT_TRUE(Overlap(a, {glm::vec2(-1, 0.4f), {2, 0.4f}, {2, 0.5f}}));
  EXPECT_FALSE(Overlap(a, {glm::vec2(1, 1), {0.6f, 1}, {1, 0.6f}}));
  EXPECT_TRUE(Contains(a, {0.25f, 0.25f}));
  EXPECT_TRUE(Contains({a[0], a[2], a[1]}, {0.25f, 0.25f}));
  EXPECT_FALSE(Contains(a, {0.75f, 0.75f}));
}

}  // namespace
}  // namespace fenestra
