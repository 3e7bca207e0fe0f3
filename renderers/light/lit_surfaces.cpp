#include "renderers/light/lit_surfaces.h"

#include <algorithm>
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

}  // namespace

std::vector<SideRadiance> LightSurfaces(const Scene& scene, const TriangleSoup& soup,
                                        const LightBake& bake, const std::vector<Spectrum>& ambient,
                                        const Lighting& lighting, Channel channel) {
  const Spectrum weights = WeightsOf(channel);
  const bool arriving = IsArriving(channel);
  const Spectrum E_sun = DaylightSpectrum(SunIlluminance(lighting), lighting);
  const Eigen::Vector3f sun = lighting.sun.Direction_W().cast<float>();
  const glm::vec3 to_sun_W(sun.x(), sun.y(), sun.z());

  std::vector<SideRadiance> sides(2 * soup.size() + 2);
  for (size_t t = 0; t < soup.size(); ++t) {
    const Material& material = scene.materials[scene.meshes[soup.mesh_of[t]].material];
    const Spectrum per_E =
        arriving ? weights : weights * ReflectanceSpectrum(material) * kInversePi;
    const float emission = arriving ? 0.0f : glm::dot(weights, EmissionSpectrum(material));
    const float sun_per_cosine = glm::dot(per_E, E_sun);
    for (const bool front : {true, false}) {
      const size_t side = SideIndex(t, front);
      const std::array<uint32_t, 3>& corners = bake.corners[side];
      if (corners[0] == LightBake::kNoPoint) continue;
      const auto at = [&](size_t k) { return glm::dot(per_E, ambient[corners[k]]) + emission; };
      const glm::vec3 cosines = SunCosines(soup, t, front, to_sun_W);
      sides[side] = {.ambient = at(0),
                     .ambient_u = at(1) - at(0),
                     .ambient_v = at(2) - at(0),
                     .sun = sun_per_cosine * cosines[0],
                     .sun_u = sun_per_cosine * (cosines[1] - cosines[0]),
                     .sun_v = sun_per_cosine * (cosines[2] - cosines[0])};
    }
  }
  if (!arriving) {
    sides.back().ambient = glm::dot(weights, GroundExitance(lighting)) * kInversePi;
  }
  return sides;
}

FENESTRA_WIDE SideGroups GroupsOf(const Lanes<uint32_t>& side_hit) {
  SideGroups groups;
  uint32_t differs = 0;
  for (int i = 0; i < kLanes; ++i) differs |= side_hit[i] ^ side_hit[0];
  groups.sides[groups.count++] = side_hit[0];
  if (differs == 0) return groups;
  for (int i = 1; i < kLanes; ++i) {
    bool is_new = true;
    for (int k = 0; k < groups.count; ++k) is_new = is_new && groups.sides[k] != side_hit[i];
    if (is_new) groups.sides[groups.count++] = side_hit[i];
  }
  return groups;
}

FENESTRA_WIDE Lanes<float> AmbientLeaving(const SideRadiance* sides, const SideGroups& groups,
                                          const Lanes<uint32_t>& side_hit,
                                          const RayPacket& packet) {
  Lanes<float> light;
  for (int k = 0; k < groups.count; ++k) {
    const uint32_t hit = groups.sides[k];
    const SideRadiance side = sides[hit];
    for (int i = 0; i < kLanes; ++i) {
      const float own =
          side.ambient + side.ambient_u * packet.hit.u[i] + side.ambient_v * packet.hit.v[i];
      light[i] = side_hit[i] == hit ? own : light[i];
    }
  }
  return light;
}

FENESTRA_WIDE Lanes<float> SunLeaving(const SideRadiance* sides, const SideGroups& groups,
                                      const Lanes<uint32_t>& side_hit, const RayPacket& packet) {
  Lanes<float> light;
  for (int k = 0; k < groups.count; ++k) {
    const uint32_t hit = groups.sides[k];
    const SideRadiance side = sides[hit];
    for (int i = 0; i < kLanes; ++i) {
      const float sun = side.sun + side.sun_u * packet.hit.u[i] + side.sun_v * packet.hit.v[i];
      light[i] = side_hit[i] == hit ? (sun > 0.0f ? sun : 0.0f) : light[i];
    }
  }
  return light;
}

}  // namespace fenestra
