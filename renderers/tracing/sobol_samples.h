#pragma once

#include <array>
#include <cstdint>

namespace fenestra {

/// The first points of Sobol's (0,2)-sequence, as 32-bit binary fractions: every aligned block of
/// 2^m points has one point in each elementary interval of area 2^-m; in particular x and y are
/// stratified to 2^-m each. Nested uniform (Owen) scrambling keeps that. Exclusive-or with a word,
/// which keeps it too, is not enough: it leaves the points' diagonal rows in place, and the error
/// at an edge of 45° is then twice that at other angles.
/// Sources: I. M. Sobol', 1967; A. B. Owen, "Randomly permuted (t,m,s)-nets", 1995.
struct SobolPoint {
  uint32_t x;
  uint32_t y;
};

constexpr SobolPoint NthSobolPoint(uint32_t index) {
  SobolPoint point{0, 0};
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

struct SobolTable {
  /// The points' bits in reverse order, least significant bit first, as OwenScrambled needs them.
  alignas(64) std::array<uint32_t, kMostPixelSamples> x;
  alignas(64) std::array<uint32_t, kMostPixelSamples> y;
};

constexpr uint32_t ReverseBits(uint32_t b) {
  b = (b >> 16) | (b << 16);
  b = ((b & 0xff00ff00u) >> 8) | ((b & 0x00ff00ffu) << 8);
  b = ((b & 0xf0f0f0f0u) >> 4) | ((b & 0x0f0f0f0fu) << 4);
  b = ((b & 0xccccccccu) >> 2) | ((b & 0x33333333u) << 2);
  return ((b & 0xaaaaaaaau) >> 1) | ((b & 0x55555555u) << 1);
}

/// Nested uniform scrambling of a fraction, given with its bits reversed: each bit is flipped
/// depending on the seed and on the more significant bits alone. Source of the hash: S. Laine and
/// T. Karras, "Stratified sampling for stochastic transparency", 2011, with the constants of
/// N. Vegdahl as in B. Burley, "Practical hash-based Owen scrambling", 2020.
constexpr uint32_t OwenScrambled(uint32_t reversed, uint32_t seed) {
  uint32_t b = reversed;
  b ^= b * 0x3d20adeau;
  b += seed;
  b *= (seed >> 16) | 1u;
  b ^= b * 0x05526c56u;
  b ^= b * 0x53a22864u;
  return ReverseBits(b);
}

constexpr SobolTable MakeSobolTable() {
  SobolTable table{};
  for (uint32_t i = 0; i < kMostPixelSamples; ++i) {
    const SobolPoint point = NthSobolPoint(i);
    table.x[i] = ReverseBits(point.x);
    table.y[i] = ReverseBits(point.y);
  }
  return table;
}

inline constexpr SobolTable kSobolTable = MakeSobolTable();

/// A binary fraction to [0, 1); 24 bits, so that the result is below 1 in single precision.
constexpr float ToUnit(uint32_t fraction) {
  return static_cast<float>(static_cast<int32_t>(fraction >> 8)) * 0x1p-24f;
}

/// A hash of 32 bits. Source: C. Wellons, "Prospecting for hash functions", 2018 (lowbias32).
constexpr uint32_t Hashed(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

/// The scrambling of one image's samples.
struct ImageScramble {
  uint32_t x;
  uint32_t y;

  constexpr explicit ImageScramble(uint64_t key)
      : x(Hashed(static_cast<uint32_t>(key))), y(Hashed(static_cast<uint32_t>(key >> 32))) {}

  /// The scrambling seeds of a pixel, along x and along y.
  constexpr SobolPoint OfPixel(uint32_t pixel) const {
    const uint32_t seed = Hashed(pixel + x);
    return {seed, Hashed(seed ^ y)};
  }
};

}  // namespace fenestra
