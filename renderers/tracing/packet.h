#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace fenestra {

/// Rays are traced sixteen at a time, as structures of arrays.
inline constexpr int kLanes = 16;

template <typename T>
struct alignas(64) Lanes {
  std::array<T, kLanes> v{};

  T& operator[](int lane) { return v[static_cast<size_t>(lane)]; }
  const T& operator[](int lane) const { return v[static_cast<size_t>(lane)]; }
  T* data() { return v.data(); }
  const T* data() const { return v.data(); }
};

/// The same value in all lanes.
template <typename T>
Lanes<T> AllLanes(T value) {
  Lanes<T> lanes;
  lanes.v.fill(value);
  return lanes;
}

/// Embree's convention: -1 traces a lane, 0 leaves it out.
using LaneMask = Lanes<int>;

struct Directions {
  Lanes<float> x;
  Lanes<float> y;
  Lanes<float> z;
};

using RayPacket = RTCRayHit16;

/// The first `count` lanes.
LaneMask FirstLanes(int count);

/// Sets all lanes to rays from one origin, without a hit. The normal of a packet's missing hits
/// is (0, -1, 0): as seen from above it faces the ray, from below it faces away, so that "the side
/// that is seen" also tells sky from ground.
void SetRays(RayPacket& packet, const glm::vec3& origin_W, const Directions& directions_W);

}  // namespace fenestra
