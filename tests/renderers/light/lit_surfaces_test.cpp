#include "renderers/light/lit_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

namespace fenestra {
namespace {

TEST(LitSurfaces, GroupsAreTheDifferentSides) {
  EXPECT_EQ(GroupsOf(AllLanes(7u)).count, 1);
  Lanes<uint32_t> side;
  for (uint32_t i = 0; i < kLanes; ++i) side.v[i] = (i * i) % 6;
  const SideGroups groups = GroupsOf(side);
  const std::set<uint32_t> expected(side.v.begin(), side.v.end());
  const std::set<uint32_t> found(groups.sides.v.begin(), groups.sides.v.begin() + groups.count);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(static_cast<size_t>(groups.count), expected.size());
}

TEST(LitSurfaces, LightIsLinearOverATriangleAndTheSunsIsNeverNegative) {
  const std::vector<SideRadiance> sides = {
      {.ambient = 10.0f, .ambient_u = 2.0f, .ambient_v = -3.0f, .sun = 5.0f, .sun_u = -20.0f},
      {.ambient = 1.0f, .ambient_u = 0.5f, .ambient_v = 0.25f, .sun = 4.0f, .sun_v = 1.0f}};
  RayPacket packet;
  Lanes<uint32_t> side;
  for (uint32_t i = 0; i < kLanes; ++i) {
    side.v[i] = i % 2;
    packet.hit.u[i] = 0.04f * static_cast<float>(i);
    packet.hit.v[i] = 0.3f;
  }
  const Lanes<float> ambient = AmbientLeaving(sides.data(), GroupsOf(side), side, packet);
  const Lanes<float> sun = SunLeaving(sides.data(), GroupsOf(side), side, packet);
  int dark = 0;
  for (int i = 0; i < kLanes; ++i) {
    const SideRadiance& s = sides[side[i]];
    const double u = packet.hit.u[i];
    const double v = packet.hit.v[i];
    EXPECT_NEAR(ambient[i], s.ambient + s.ambient_u * u + s.ambient_v * v, 1e-5) << i;
    EXPECT_NEAR(sun[i], std::max(0.0, s.sun + s.sun_u * u + s.sun_v * v), 1e-5) << i;
    dark += sun[i] == 0.0f;
  }
  EXPECT_GT(dark, 0);
}

}  // namespace
}  // namespace fenestra
