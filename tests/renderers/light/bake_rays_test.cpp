#include "renderers/light/bake_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "renderers/tracing/triangle_soup.h"

namespace fenestra {
namespace {

// Squares of 0.1 m that share no vertex, in a floor and a wall of 3 m.
TriangleSoup LooseTiles() {
  constexpr int kSide = 30;
  Scene scene;
  scene.materials = {{.name = "grey"}};
  Mesh mesh{.name = "tiles"};
  for (int i = 0; i < kSide * kSide; ++i) {
    for (const bool floor : {true, false}) {
      const float x = 0.1f * static_cast<float>(i / kSide);
      const float y = 0.1f * static_cast<float>(i % kSide);
      const auto base = static_cast<uint32_t>(mesh.positions_W.size());
      for (const auto& [a, b] : {std::pair(0.0f, 0.0f), {0.1f, 0.0f}, {0.1f, 0.1f}, {0.0f, 0.1f}}) {
        mesh.positions_W.push_back(floor ? glm::vec3(x + a, 0.0f, y + b)
                                         : glm::vec3(x + a, y + b, 0.0f));
      }
      mesh.triangles.push_back(glm::uvec3(0, 1, 2) + base);
      mesh.triangles.push_back(glm::uvec3(0, 2, 3) + base);
    }
  }
  scene.meshes = {std::move(mesh)};
  return MakeTriangleSoup(scene, Material::Kind::kLambert);
}

TEST(ThinnedCorners, AreFewAndNearAndFaceAlike) {
  const TriangleSoup soup = LooseTiles();
  const SharedCorners all = FindSharedCorners(soup, NumberSurfaces(soup));
  EXPECT_EQ(all.corners.size(), 4u * 2u * 900u);
  for (const size_t most : {7199u, 2000u, 200u, 50u}) {
    const SharedCorners few = Thinned(all, most);
    EXPECT_LE(few.corners.size(), most);
    EXPECT_GT(few.corners.size(), most / 12);  // The next finer grid has up to 8 times as many.
    // 18 m² in so many cells, each no longer than the square root of twice its area, if a cell may
    // be a tenth full.
    const double reach_m = std::sqrt(2.0 * 12.0 * 18.0 / static_cast<double>(most));
    for (size_t t = 0; t < soup.size(); ++t) {
      for (size_t k = 0; k < 3; ++k) {
        const SharedCorner& own = all.corners[all.of_triangle[t][k]];
        const SharedCorner& shared = few.corners.at(few.of_triangle[t][k]);
        EXPECT_LT(static_cast<double>(glm::distance(own.p_W, shared.p_W)), reach_m);
        EXPECT_EQ(own.n_W, shared.n_W);
      }
    }
  }
}

TEST(ThinnedCorners, FewStayAsTheyAre) {
  const TriangleSoup soup = LooseTiles();
  const SharedCorners all = FindSharedCorners(soup, NumberSurfaces(soup));
  EXPECT_EQ(Thinned(all, all.corners.size()).of_triangle, all.of_triangle);
}

// Even where directions alone are more than is allowed, it ends.
TEST(ThinnedCorners, OneForEachDirectionRemains) {
  const TriangleSoup soup = LooseTiles();
  EXPECT_LE(Thinned(FindSharedCorners(soup, NumberSurfaces(soup)), 1).corners.size(), 16u);
}

}  // namespace
}  // namespace fenestra
