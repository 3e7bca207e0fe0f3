#include "renderers/light/bake_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>
#include <vector>

namespace fenestra {
namespace {

// The corners of squares of 0.1 m, in a floor and a wall of 3 m.
std::vector<BakePoint> LooseTiles() {
  constexpr int kSide = 30;
  std::vector<BakePoint> points;
  for (int i = 0; i < kSide * kSide; ++i) {
    const float x = 0.1f * static_cast<float>(i / kSide);
    const float y = 0.1f * static_cast<float>(i % kSide);
    for (const auto& [a, b] : {std::pair(0.0f, 0.0f), {0.1f, 0.0f}, {0.1f, 0.1f}, {0.0f, 0.1f}}) {
      points.push_back({{x + a, 0.0f, y + b}, {0.0f, 1.0f, 0.0f}});
      points.push_back({{x + a, y + b, 0.0f}, {0.0f, 0.0f, 1.0f}});
    }
  }
  return points;
}

TEST(SharedPoints, AreFewAndNearAndFaceAlike) {
  const std::vector<BakePoint> points = LooseTiles();
  ASSERT_EQ(points.size(), 4u * 2u * 900u);
  for (const size_t most : {7199u, 2000u, 200u, 50u}) {
    const std::vector<size_t> shared = SharedPoints(points, most);
    const size_t count = std::set(shared.begin(), shared.end()).size();
    EXPECT_LE(count, most);
    EXPECT_GT(count, most / 12);  // The next finer grid has up to 8 times as many.
    // 18 m² in so many cells, each no longer than the square root of twice its area, if a cell may
    // be a tenth full.
    const double reach_m = std::sqrt(2.0 * 12.0 * 18.0 / static_cast<double>(most));
    for (size_t i = 0; i < points.size(); ++i) {
      const BakePoint& other = points[shared[i]];
      EXPECT_EQ(shared[shared[i]], shared[i]);
      EXPECT_LE(shared[i], i);
      EXPECT_LT(static_cast<double>(glm::distance(points[i].p_W, other.p_W)), reach_m);
      EXPECT_EQ(points[i].n_W, other.n_W);
    }
  }
}

TEST(SharedPoints, FewStayAsTheyAre) {
  const std::vector<BakePoint> points = LooseTiles();
  const std::vector<size_t> shared = SharedPoints(points, points.size());
  for (size_t i = 0; i < points.size(); ++i) EXPECT_EQ(shared[i], i);
}

// Even where directions alone are more than is allowed, it ends.
TEST(SharedPoints, OneForEachDirectionRemains) {
  const std::vector<size_t> shared = SharedPoints(LooseTiles(), 1);
  EXPECT_LE(std::set(shared.begin(), shared.end()).size(), 16u);
}

}  // namespace
}  // namespace fenestra
