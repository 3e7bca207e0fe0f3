#include "core/random_stream.h"

#include <Random123/philox.h>

#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "core/check.h"

namespace fenestra {
namespace {

using Philox = r123::Philox4x32;

// The last counter word keeps the uses of one key apart.
enum class Use : uint32_t { kChild = 0, kScalar = 1, kNormals = 2, kUniforms = 3 };

Philox::ctr_type Cipher(uint64_t key, uint64_t index, uint32_t word, Use use) {
  const Philox::ctr_type counter = {{static_cast<uint32_t>(index),
                                     static_cast<uint32_t>(index >> 32), word,
                                     static_cast<uint32_t>(use)}};
  const Philox::key_type philox_key = {
      {static_cast<uint32_t>(key), static_cast<uint32_t>(key >> 32)}};
  return Philox()(counter, philox_key);
}

// FNV-1a, 32 bit.
uint32_t HashOf(std::string_view text) {
  uint32_t hash = 2166136261u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

uint64_t Join(uint32_t low, uint32_t high) {
  return static_cast<uint64_t>(low) | (static_cast<uint64_t>(high) << 32);
}

// Applies `convert` to consecutive 32-bit words of the sequence `use` of the key.
template <typename Convert>
void FillWords(uint64_t key, Use use, std::span<float> out, Convert convert) {
  for (size_t first = 0; first < out.size(); first += 4) {
    const Philox::ctr_type words = Cipher(key, first / 4, 0, use);
    const size_t count = std::min<size_t>(4, out.size() - first);
    for (size_t i = 0; i < count; ++i) out[first + i] = convert(words.v[i]);
  }
}

}  // namespace

RandomStream RandomStream::Child(std::string_view purpose, uint64_t index) const {
  const Philox::ctr_type words = Cipher(key_, index, HashOf(purpose), Use::kChild);
  return RandomStream(Join(words.v[0], words.v[1]));
}

double RandomStream::Uniform(uint64_t index) const {
  const Philox::ctr_type words = Cipher(key_, index, 0, Use::kScalar);
  // 52 bits and a half are exact in a double: neither 0 nor 1 can come out.
  const uint64_t bits = Join(words.v[0], words.v[1]) >> 12;
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

double RandomStream::Normal(uint64_t index) const {
  return -std::sqrt(2.0) * boost::math::erfc_inv(2.0 * Uniform(index));
}

void RandomStream::FillNormals(std::span<float> out) const {
  FillWords(key_, Use::kNormals, out, [](uint32_t word) {
    // The lower half of the distribution is computed and the sign bit mirrors it: the tails keep
    // all bits that a float near 1 would lose.
    const float p = (static_cast<float>(word >> 1) + 0.5f) * 0x1p-32f;  // (0, 1/2]
    const float x = NormalQuantileSingle(std::min(p, 0.5f));
    return (word & 1u) != 0 ? -x : x;
  });
}

void RandomStream::FillUniforms(std::span<float> out) const {
  FillWords(key_, Use::kUniforms, out,
            [](uint32_t word) { return (static_cast<float>(word >> 8) + 0.5f) * 0x1p-24f; });
}

float NormalQuantileSingle(float p) {
  const float q = p - 0.5f;
  if (std::abs(q) <= 0.425f) {
    const float r = 0.180625f - q * q;
    return q *
           (((5.9109374720e+01f * r + 1.5929113202e+02f) * r + 5.0434271938e+01f) * r +
            3.3871327179e+00f) /
           (((6.7187563600e+01f * r + 7.8757757664e+01f) * r + 1.7895169469e+01f) * r + 1.0f);
  }
  float r = std::sqrt(-std::log(q < 0.0f ? p : 1.0f - p));
  float x;
  if (r <= 5.0f) {
    r -= 1.6f;
    x = (((1.7023821103e-01f * r + 1.3067284816e+00f) * r + 2.7568153900e+00f) * r +
         1.4234372777e+00f) /
        ((1.2021132975e-01f * r + 7.3700164250e-01f) * r + 1.0f);
  } else {
    r -= 5.0f;
    x = (((1.7337203997e-02f * r + 4.2868294337e-01f) * r + 3.0812263860e+00f) * r +
         6.6579051150e+00f) /
        ((1.2258202635e-02f * r + 2.4197894225e-01f) * r + 1.0f);
  }
  return q < 0.0f ? -x : x;
}

}  // namespace fenestra
