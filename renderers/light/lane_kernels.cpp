#include "renderers/light/lane_kernels.h"

#include <cmath>

#include "core/system/wide.h"

namespace fenestra {

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
    const SobolPoint seed = scramble.OfPixel(index + row * width + column);
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
