#include "scenes/facade/facade_plant.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/facade/facade.h"
#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

FacadeOptions Overgrown(double coverage) {
  FacadeOptions o;
  o.window.setback_m = 0.1;
  o.plant.coverage = coverage;
  return o;
}

bool Covers(const Mesh& mesh, const glm::uvec3& t, float x, float y) {
  const auto left_of = [x, y](const glm::vec3& p, const glm::vec3& q) {
    return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) > 0.0f;
  };
  const bool a = left_of(mesh.positions_W[t.x], mesh.positions_W[t.y]);
  return a == left_of(mesh.positions_W[t.y], mesh.positions_W[t.z]) &&
         a == left_of(mesh.positions_W[t.z], mesh.positions_W[t.x]);
}

// Share of points of a 1 m frame, 0.1 m wide, that leaves cover as seen along the normal.
double Coverage(const Mesh& plant) {
  constexpr int kSteps = 250;
  int covered = 0;
  int all = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      const float x = -0.5f + (static_cast<float>(i) + 0.5f) / kSteps;
      const float y = -0.5f + (static_cast<float>(k) + 0.5f) / kSteps;
      if (std::max(std::abs(x), std::abs(y)) < 0.4f) continue;
      ++all;
      covered += std::ranges::any_of(plant.triangles,
                                     [&](const glm::uvec3& t) { return Covers(plant, t, x, y); });
    }
  }
  return static_cast<double>(covered) / all;
}

// A leaf covers at most 0.5 · 0.65 · (1.3 · 0.07 m)² = 0.0027 m² of the frame's 0.36 m²; both maps
// have thousands of pixels along the leaves' edges.
TEST(Plant, CoversTheGivenShareOfTheFrame) {
  for (const double coverage : {0.1, 0.5, 0.9}) {
    const Scene scene = MakeFacade(Overgrown(coverage));
    EXPECT_NEAR(Coverage(*Find(scene, "plant")), coverage, 0.01) << coverage;
  }
}

TEST(Plant, GrowsWithoutChangingWhatHasGrown) {
  const Scene young = MakeFacade(Overgrown(0.2));
  const Scene old = MakeFacade(Overgrown(0.4));
  const auto& few = Find(young, "plant")->positions_W;
  const auto& many = Find(old, "plant")->positions_W;
  ASSERT_LT(few.size(), many.size());
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
}

TEST(Plant, StaysBeforeTheWallAndIsBrightInTheInfrared) {
  const Scene scene = MakeFacade(Overgrown(0.5));
  const Mesh& plant = *Find(scene, "plant");
  for (const glm::vec3& p : plant.positions_W) EXPECT_GT(p.z, 0.0f);
  const Material& leaf = scene.materials[plant.material];
  EXPECT_GT(leaf.reflectance_830nm, 4.0f * leaf.reflectance_rgb.g * 0.7f);
  ASSERT_EQ(plant.colors.size(), plant.positions_W.size());
}

}  // namespace
}  // namespace fenestra
