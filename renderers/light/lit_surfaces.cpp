#include "renderers/light/lit_surfaces.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/system/wide.h"

namespace fenestra {
namespace {

constexpr float kInversePi = 1.0f / std::numbers::pi_v<float>;

// Cosines of the sun's angles of incidence at the corners of a side, 0 if it is behind the side.
glm::vec3 SunCosines(const TriangleSoup& soup, size_t triangle, bool front,
                     const glm::vec3& to_sun_W) {
  const float sign = front ? 1.0f : -1.0f;
  const float cosine = sign * glm::dot(soup.normals_W[triangle], to_sun_W);
  if (!(cosine > 0.0f)) return glm::vec3(0.0f);
  if (!soup.is_smooth(triangle)) return glm::vec3(cosine);
  glm::vec3 cosines;
  for (int k = 0; k < 3; ++k) {
    const glm::vec3& n = soup.vertex_normals_W[soup.triangles[triangle][k]];
    // Opposite normals stand for the same surface.
    const float same = glm::dot(n, soup.normals_W[triangle]) < 0.0f ? -sign : sign;
    cosines[k] = same * glm::dot(n, to_sun_W);
  }
  return cosines;
}

// After the leaves: the inside of bodies, from which no light comes.
uint32_t DarkLeaf(const LightBake& bake) {
  return GroundLeaf(bake) + 1;
}

}  // namespace

SurfaceLight LightSurfaces(const Scene& scene, const TriangleSoup& soup, const LightBake& bake,
                           const std::vector<Spectrum>& ambient, const Lighting& lighting,
                           Channel channel) {
  const Spectrum weights = WeightsOf(channel);
  const bool arriving = IsArriving(channel);
  const Spectrum E_sun = DaylightSpectrum(SunIlluminance(lighting), lighting);
  const Eigen::Vector3f sun = lighting.sun.Direction_W().cast<float>();
  const glm::vec3 to_sun_W(sun.x(), sun.y(), sun.z());
  const auto material_of = [&](uint32_t triangle) -> const Material& {
    return scene.materials[scene.meshes[soup.mesh_of[triangle]].material];
  };
  const auto per_irradiance = [&](const Material& material) {
    return arriving ? weights : weights * ReflectanceSpectrum(material) * kInversePi;
  };

  SurfaceLight light;
  light.ambient.reserve(bake.leaves.leaves().size() + 2);
  for (const LightLeaves::Leaf& leaf : bake.leaves.leaves()) {
    const Material& material = material_of(bake.patches.PatchOfFace(leaf.face).triangles.front());
    const Spectrum per_E = per_irradiance(material);
    const float emission = arriving ? 0.0f : glm::dot(weights, EmissionSpectrum(material));
    std::array<float, 3> values{};
    for (size_t k = 0; k < 3; ++k) values[k] = glm::dot(per_E, ambient[leaf.points[k]]) + emission;
    const std::array<float, 3> c = leaf.Interpolate(values);
    light.ambient.push_back({c[0], c[1], c[2]});
  }
  light.ambient.resize(light.ambient.size() + 3);
  if (!arriving) {
    light.ambient[GroundLeaf(bake)].at_0 = glm::dot(weights, GroundExitance(lighting)) * kInversePi;
  }

  light.sun.resize(2 * soup.size() + 2);
  for (uint32_t t = 0; t < soup.size(); ++t) {
    const float per_cosine = glm::dot(per_irradiance(material_of(t)), E_sun);
    for (const bool front : {true, false}) {
      if (!front && soup.is_closed[t]) continue;
      const glm::vec3 cosines = SunCosines(soup, t, front, to_sun_W);
      light.sun[SideIndex(t, front)] = {per_cosine * cosines[0],
                                        per_cosine * (cosines[1] - cosines[0]),
                                        per_cosine * (cosines[2] - cosines[0])};
    }
  }
  return light;
}

FENESTRA_WIDE LaneGroups GroupsOf(const Lanes<uint32_t>& values) {
  LaneGroups groups;
  uint32_t differs = 0;
  for (int i = 0; i < kLanes; ++i) differs |= values[i] ^ values[0];
  groups.values[groups.count++] = values[0];
  if (differs == 0) return groups;
  for (int i = 1; i < kLanes; ++i) {
    bool is_new = true;
    for (int k = 0; k < groups.count; ++k) is_new = is_new && groups.values[k] != values[i];
    if (is_new) groups.values[groups.count++] = values[i];
  }
  return groups;
}

LeavesHit FindLeaves(const LightBake& bake, const Lanes<uint32_t>& side_hit,
                     const RayPacket& packet) {
  const LightLeaves& leaves = bake.leaves;
  const auto leaf_count = static_cast<uint32_t>(leaves.leaves().size());
  LeavesHit found;
  for (int i = 0; i < kLanes; ++i) {
    if (packet.hit.primID[i] == RTC_INVALID_GEOMETRY_ID) {
      found.leaf[i] = side_hit[i] % 2 == 0 ? SkyLeaf(bake) : GroundLeaf(bake);
      continue;
    }
    const glm::vec2 st = bake.patches.At(packet.hit.primID[i], packet.hit.u[i], packet.hit.v[i]);
    found.s[i] = st.x;
    found.t[i] = st.y;
    const uint32_t face = bake.patches.FaceOf(side_hit[i]);
    // Neighbouring rays mostly meet the same leaf.
    if (i > 0) {
      const uint32_t last = found.leaf[i - 1];
      if (last < leaf_count && leaves.leaves()[last].face == face && leaves.IsIn(last, st)) {
        found.leaf[i] = last;
        continue;
      }
    }
    const uint32_t leaf = leaves.Find(face, st);
    found.leaf[i] = leaf == LightLeaves::kNone ? DarkLeaf(bake) : leaf;
  }
  found.groups = GroupsOf(found.leaf);
  return found;
}

FENESTRA_WIDE Lanes<float> AmbientLeaving(const LinearLight* ambient, const LeavesHit& hit) {
  Lanes<float> light;
  for (int k = 0; k < hit.groups.count; ++k) {
    const uint32_t leaf = hit.groups.values[k];
    const LinearLight of_leaf = ambient[leaf];
    for (int i = 0; i < kLanes; ++i) {
      const float own = of_leaf.at_0 + of_leaf.per_x * hit.s[i] + of_leaf.per_y * hit.t[i];
      light[i] = hit.leaf[i] == leaf ? own : light[i];
    }
  }
  return light;
}

FENESTRA_WIDE Lanes<float> SunLeaving(const LinearLight* sun, const LaneGroups& groups,
                                      const Lanes<uint32_t>& side_hit, const RayPacket& packet) {
  Lanes<float> light;
  for (int k = 0; k < groups.count; ++k) {
    const uint32_t side = groups.values[k];
    const LinearLight of_side = sun[side];
    for (int i = 0; i < kLanes; ++i) {
      const float own =
          of_side.at_0 + of_side.per_x * packet.hit.u[i] + of_side.per_y * packet.hit.v[i];
      light[i] = side_hit[i] == side ? (own > 0.0f ? own : 0.0f) : light[i];
    }
  }
  return light;
}

}  // namespace fenestra
