#include "renderers/lane_kernels.h"

#include <cmath>
#include <limits>

#include "core/wide.h"
#include "renderers/fresnel.h"
#include "renderers/net_samples.h"

namespace fenestra {
namespace {

// A ray that hits nothing goes to infinity. Embree's packets of 4 and 8, though not those of 16,
// insist on finite origins even in lanes that are not traced.
inline float FiniteOr0(float t) {
  return t < std::numeric_limits<float>::max() ? t : 0.0f;
}

}  // namespace

FloatPose ToFloat(const Pose& X_WC) {
  const auto to_vec3 = [](const auto& v) {
    return glm::vec3(static_cast<float>(v.x()), static_cast<float>(v.y()),
                     static_cast<float>(v.z()));
  };
  const Eigen::Matrix3d& R = X_WC.rotation();
  return {.p_WC = to_vec3(X_WC.translation()),
          .axes = {.right_W = to_vec3(R.col(0)),
                   .down_W = to_vec3(R.col(1)),
                   .forward_W = to_vec3(R.col(2))}};
}

FENESTRA_WIDE Directions ToWorld(const CameraAxes& axes, const Lanes<float>& x,
                                 const Lanes<float>& y) {
  Directions d;
  for (int i = 0; i < kLanes; ++i) {
    d.x[i] = x[i] * axes.right_W.x + y[i] * axes.down_W.x + axes.forward_W.x;
    d.y[i] = x[i] * axes.right_W.y + y[i] * axes.down_W.y + axes.forward_W.y;
    d.z[i] = x[i] * axes.right_W.z + y[i] * axes.down_W.z + axes.forward_W.z;
  }
  return d;
}

FENESTRA_WIDE PixelBlock MakePixelBlock(uint32_t corner, uint32_t stride, uint32_t index,
                                        uint32_t width, const ImageScramble& scramble) {
  PixelBlock block;
  for (uint32_t i = 0; i < kLanes; ++i) {
    const uint32_t column = i % kBlockSide;
    const uint32_t row = i / kBlockSide;
    const NetPoint seed = scramble.OfPixel(index + row * width + column);
    block.corner.v[i] = corner + row * stride + column;
    block.seed_x.v[i] = seed.x;
    block.seed_y.v[i] = seed.y;
  }
  return block;
}

FENESTRA_WIDE PixelPoints ScrambledPoints(const Lanes<uint32_t>& net_x,
                                          const Lanes<uint32_t>& net_y,
                                          const Lanes<uint32_t>& seed_x,
                                          const Lanes<uint32_t>& seed_y) {
  PixelPoints points;
  for (int i = 0; i < kLanes; ++i) {
    points.s[i] = ToUnit(OwenScrambled(net_x[i], seed_x[i]));
    points.t[i] = ToUnit(OwenScrambled(net_y[i], seed_y[i]));
  }
  return points;
}

FENESTRA_WIDE PixelPatches PatchesOf(const float* corner_data, const Lanes<uint32_t>& corner,
                                     uint32_t stride) {
  PixelPatches p;
  for (int i = 0; i < kLanes; ++i) {
    const float* top = corner_data + 2 * corner[i];
    const float* low = top + 2 * stride;
    p.x0[i] = top[0];
    p.xs[i] = top[2] - top[0];
    p.xt[i] = low[0] - top[0];
    p.xst[i] = (low[2] - low[0]) - (top[2] - top[0]);
    p.y0[i] = top[1];
    p.ys[i] = top[3] - top[1];
    p.yt[i] = low[1] - top[1];
    p.yst[i] = (low[3] - low[1]) - (top[3] - top[1]);
  }
  return p;
}

FENESTRA_WIDE ImagePoints InPixels(const PixelPatches& p, const PixelPoints& points) {
  ImagePoints out;
  for (int i = 0; i < kLanes; ++i) {
    const float s = points.s[i];
    const float t = points.t[i];
    out.x[i] = p.x0[i] + s * p.xs[i] + t * (p.xt[i] + s * p.xst[i]);
    out.y[i] = p.y0[i] + s * p.ys[i] + t * (p.yt[i] + s * p.yst[i]);
  }
  return out;
}

FENESTRA_WIDE Lanes<uint32_t> SidesHit(const RayPacket& packet, uint32_t triangle_count) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  Lanes<uint32_t> side;
  for (int i = 0; i < kLanes; ++i) {
    const float facing =
        hit.Ng_x[i] * ray.dir_x[i] + hit.Ng_y[i] * ray.dir_y[i] + hit.Ng_z[i] * ray.dir_z[i];
    const uint32_t triangle =
        hit.primID[i] == RTC_INVALID_GEOMETRY_ID ? triangle_count : hit.primID[i];
    side[i] = 2 * triangle + (facing < 0.0f ? 0u : 1u);
  }
  return side;
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

FENESTRA_WIDE RTCRay16 RaysFromHits(const RayPacket& packet, float offset_m,
                                    const glm::vec3& direction_W) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  RTCRay16 out;
  for (int i = 0; i < kLanes; ++i) {
    const float nx = hit.Ng_x[i];
    const float ny = hit.Ng_y[i];
    const float nz = hit.Ng_z[i];
    const float facing = nx * ray.dir_x[i] + ny * ray.dir_y[i] + nz * ray.dir_z[i];
    const float unit = offset_m / std::sqrt(nx * nx + ny * ny + nz * nz);
    const float off = facing < 0.0f ? unit : -unit;
    const float t = FiniteOr0(ray.tfar[i]);
    out.org_x[i] = ray.org_x[i] + t * ray.dir_x[i] + off * nx;
    out.org_y[i] = ray.org_y[i] + t * ray.dir_y[i] + off * ny;
    out.org_z[i] = ray.org_z[i] + t * ray.dir_z[i] + off * nz;
    out.tnear[i] = 0.0f;
    out.dir_x[i] = direction_W.x;
    out.dir_y[i] = direction_W.y;
    out.dir_z[i] = direction_W.z;
    out.time[i] = 0.0f;
    out.tfar[i] = std::numeric_limits<float>::infinity();
    out.mask[i] = ~0u;
    out.id[i] = 0u;
    out.flags[i] = 0u;
  }
  return out;
}

FENESTRA_WIDE Lanes<float> PaneReflectances(const LaneMask& panes, const RayPacket& packet,
                                            const float* index) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  // Fetched first, so that the arithmetic is done in all lanes at once.
  Lanes<float> n;
  for (int i = 0; i < kLanes; ++i) n[i] = index[panes[i] != 0 ? hit.primID[i] : 0u];
  Lanes<float> reflectance;
  for (int i = 0; i < kLanes; ++i) {
    const float nx = hit.Ng_x[i];
    const float ny = hit.Ng_y[i];
    const float nz = hit.Ng_z[i];
    const float dx = ray.dir_x[i];
    const float dy = ray.dir_y[i];
    const float dz = ray.dir_z[i];
    const float nn = nx * nx + ny * ny + nz * nz;
    const float dd = dx * dx + dy * dy + dz * dz;
    const float nd = nx * dx + ny * dy + nz * dz;
    const float cosine = (nd < 0.0f ? -nd : nd) / std::sqrt(nn * dd);
    const float R = PaneReflectance(cosine, n[i]);
    reflectance[i] = panes[i] != 0 ? R : 0.0f;
  }
  return reflectance;
}

FENESTRA_WIDE RayPacket MirroredRays(const LaneMask& panes, const RayPacket& packet,
                                     float offset_m) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  RayPacket out;
  for (int i = 0; i < kLanes; ++i) {
    const bool on = panes[i] != 0;
    const float nx = hit.Ng_x[i];
    const float ny = hit.Ng_y[i];
    const float nz = hit.Ng_z[i];
    const float dx = ray.dir_x[i];
    const float dy = ray.dir_y[i];
    const float dz = ray.dir_z[i];
    const float nn = nx * nx + ny * ny + nz * nz;
    const float nd = nx * dx + ny * dy + nz * dz;
    const float twice = 2.0f * nd / nn;
    const float unit = offset_m / std::sqrt(nn);
    const float off = nd < 0.0f ? unit : -unit;
    const float t = FiniteOr0(ray.tfar[i]);
    out.ray.org_x[i] = ray.org_x[i] + t * dx + off * nx;
    out.ray.org_y[i] = ray.org_y[i] + t * dy + off * ny;
    out.ray.org_z[i] = ray.org_z[i] + t * dz + off * nz;
    out.ray.tnear[i] = 0.0f;
    out.ray.dir_x[i] = on ? dx - twice * nx : 0.0f;
    out.ray.dir_y[i] = on ? dy - twice * ny : 0.0f;
    out.ray.dir_z[i] = on ? dz - twice * nz : 0.0f;
    out.ray.time[i] = 0.0f;
    out.ray.tfar[i] = std::numeric_limits<float>::infinity();
    out.ray.mask[i] = ~0u;
    out.ray.id[i] = 0u;
    out.ray.flags[i] = 0u;
    out.hit.Ng_x[i] = 0.0f;
    out.hit.Ng_y[i] = -1.0f;
    out.hit.Ng_z[i] = 0.0f;
    out.hit.u[i] = 0.0f;
    out.hit.v[i] = 0.0f;
    out.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
    out.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    out.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  return out;
}

FENESTRA_WIDE Lanes<float> PixelWidths(const RayPacket& packet, const Lanes<float>& before,
                                       float spread) {
  constexpr float kLeastCosine = 0.01f;
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  Lanes<float> widths;
  for (int i = 0; i < kLanes; ++i) {
    const float nx = hit.Ng_x[i];
    const float ny = hit.Ng_y[i];
    const float nz = hit.Ng_z[i];
    const float dx = ray.dir_x[i];
    const float dy = ray.dir_y[i];
    const float dz = ray.dir_z[i];
    const float nn = nx * nx + ny * ny + nz * nz;
    const float dd = dx * dx + dy * dy + dz * dz;
    const float nd = nx * dx + ny * dy + nz * dz;
    const float cosine = (nd < 0.0f ? -nd : nd) / std::sqrt(nn * dd);
    const float limited = cosine > kLeastCosine ? cosine : kLeastCosine;
    widths[i] = spread * (before[i] + ray.tfar[i]) / std::sqrt(limited);
  }
  return widths;
}

FENESTRA_WIDE Lanes<uint32_t> LookUp(const uint32_t* table, const Lanes<uint32_t>& index) {
  Lanes<uint32_t> out;
  for (int i = 0; i < kLanes; ++i) out[i] = table[index[i]];
  return out;
}

}  // namespace fenestra
