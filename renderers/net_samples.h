#pragma once

#include <array>
#include <cstdint>

namespace fenestra {

/// The first points of Sobol's (0,2)-sequence, as 32-bit binary fractions: every aligned block of
/// 2^m points has one point in each elementary interval of area 2^-m; in particular x and y are
/// stratified to 2^-m each. Exclusive-or with fixed words (digital scrambling) keeps that.
/// Source: I. M. Sobol', 1967; T. Kollig and A. Keller, "Efficient multidimensional sampling", 2002.
struct NetPoint {
  uint32_t x;
  uint32_t y;
};

constexpr NetPoint SobolPoint(uint32_t index) {
  NetPoint point{0, 0};
  uint32_t vx = 1u << 31;
  uint32_t vy = 1u << 31;
  for (; index != 0; index >>= 1) {
    if ((index & 1u) != 0) {
      point.x ^= vx;
      point.y ^= vy;
    }
    vx >>= 1;
    vy ^= vy >> 1;
  }
  return point;
}

inline constexpr int kMostPixelSamples = 256;

struct NetTable {
  alignas(64) std::array<uint32_t, kMostPixelSamples> x;
  alignas(64) std::array<uint32_t, kMostPixelSamples> y;
};

constexpr NetTable MakeNetTable() {
  NetTable table{};
  for (uint32_t i = 0; i < kMostPixelSamples; ++i) {
    const NetPoint point = SobolPoint(i);
    table.x[i] = point.x;
    table.y[i] = point.y;
  }
  return table;
}

inline constexpr NetTable kNetTable = MakeNetTable();

/// A binary fraction to [0, 1); 24 bits, so that the result is below 1 in single precision.
constexpr float ToUnit(uint32_t fraction) {
  return static_cast<float>(static_cast<int32_t>(fraction >> 8)) * 0x1p-24f;
}

/// The scrambling words of a pixel. SplitMix64's finaliser: G. L. Steele, D. Lea and C. H. Flood,
/// "Fast splittable pseudorandom number generators", OOPSLA 2014.
constexpr NetPoint ScrambleOf(uint64_t key, uint64_t pixel) {
  uint64_t z = key + (pixel + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return {static_cast<uint32_t>(z), static_cast<uint32_t>(z >> 32)};
}

}  // namespace fenestra
