#include "renderers/light/lit_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

namespace fenestra {
namespace {

TEST(LitSurfaces, GroupsAreTheDifferentValues) {
  EXPECT_EQ(GroupsOf(AllLanes(7u)).count, 1);
  Lanes<uint32_t> values;
  for (uint32_t i = 0; i < kLanes; ++i) values.v[i] = (i * i) % 6;
  const LaneGroups groups = GroupsOf(values);
  const std::set<uint32_t> expected(values.v.begin(), values.v.end());
  const std::set<uint32_t> found(groups.values.v.begin(), groups.values.v.begin() + groups.count);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(static_cast<size_t>(groups.count), expected.size());
}

TEST(LitSurfaces, LightIsLinearAndTheSunsIsNeverNegative) {
  const std::vector<LinearLight> ambient = {{10.0f, 2.0f, -3.0f}, {1.0f, 0.5f, 0.25f}};
  const std::vector<LinearLight> sun = {{5.0f, -20.0f, 0.0f}, {4.0f, 0.0f, 1.0f}};
  RayPacket packet;
  LeavesHit hit;
  for (uint32_t i = 0; i < kLanes; ++i) {
    hit.leaf.v[i] = i % 2;
    packet.hit.u[i] = hit.s.v[i] = 0.04f * static_cast<float>(i);
    packet.hit.v[i] = hit.t.v[i] = 0.3f;
  }
  hit.groups = GroupsOf(hit.leaf);
  const Lanes<float> L_ambient = AmbientLeaving(ambient.data(), hit);
  const Lanes<float> L_sun = SunLeaving(sun.data(), hit.groups, hit.leaf, packet);
  int dark = 0;
  for (int i = 0; i < kLanes; ++i) {
    const auto at = [&](const LinearLight& light) {
      return light.at_0 + light.per_x * hit.s[i] + light.per_y * hit.t[i];
    };
    EXPECT_NEAR(L_ambient[i], at(ambient[hit.leaf[i]]), 1e-5f) << i;
    EXPECT_NEAR(L_sun[i], std::max(0.0f, at(sun[hit.leaf[i]])), 1e-5f) << i;
    dark += L_sun[i] == 0.0f;
  }
  EXPECT_GT(dark, 0);
}

}  // namespace
}  // namespace fenestra
