#include "core/random/random_stream.h"

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "core/geometry/pose.h"
#include "core/random/random_words.h"

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

// Applies `convert` to consecutive runs of 32-bit words of the sequence `use` of the key.
template <typename Convert>
void FillWords(uint64_t key, Use use, std::span<float> out, Convert convert) {
  constexpr size_t kRun = 1024;
  std::array<uint32_t, kRun> words;
  for (size_t first = 0; first < out.size(); first += kRun) {
    const size_t count = std::min(kRun, out.size() - first);
    const std::span<uint32_t> run(words.data(), count);
    FillPhiloxWords(key, static_cast<uint32_t>(use), first / 4, run);
    convert(run, out.subspan(first, count));
  }
}

Eigen::Vector3d NormalVector(const RandomStream& stream, double sigma) {
  return sigma * Eigen::Vector3d(stream.Normal(0), stream.Normal(1), stream.Normal(2));
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
  FillWords(key_, Use::kNormals, out, NormalsOfWords);
}

void RandomStream::FillUniforms(std::span<float> out) const {
  FillWords(key_, Use::kUniforms, out, [](std::span<uint32_t> words, std::span<float> uniforms) {
    for (size_t i = 0; i < words.size(); ++i) {
      uniforms[i] = (static_cast<float>(words[i] >> 8) + 0.5f) * 0x1p-24f;
    }
  });
}

Pose RandomPose(const RandomStream& stream, double rotation_rad, double translation_m) {
  return Pose(RotationFromVector(NormalVector(stream.Child("rotation"), rotation_rad)),
              NormalVector(stream.Child("translation"), translation_m));
}

}  // namespace fenestra
