#include "core/random/random_stream.h"

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "core/geometry/pose.h"
#include "core/system/check.h"
#include "core/system/wide.h"

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

// Salmon et al. 2011.
constexpr uint32_t kMultiplier0 = 0xD2511F53;
constexpr uint32_t kMultiplier1 = 0xCD9E8D57;
constexpr uint32_t kWeyl0 = 0x9E3779B9;
constexpr uint32_t kWeyl1 = 0xBB67AE85;
constexpr int kRounds = 10;

// Blocks that are enciphered side by side.
constexpr size_t kBlocks = 16;

struct Blocks {
  alignas(64) uint32_t x[4][kBlocks];
};

FENESTRA_WIDE void Encipher(uint64_t key, uint32_t use, uint64_t first_block, Blocks& blocks) {
  for (size_t i = 0; i < kBlocks; ++i) {
    const uint64_t counter = first_block + static_cast<uint64_t>(i);
    blocks.x[0][i] = static_cast<uint32_t>(counter);
    blocks.x[1][i] = static_cast<uint32_t>(counter >> 32);
    blocks.x[2][i] = 0;
    blocks.x[3][i] = use;
  }
  auto key0 = static_cast<uint32_t>(key);
  auto key1 = static_cast<uint32_t>(key >> 32);
  for (int round = 0; round < kRounds; ++round) {
    for (size_t i = 0; i < kBlocks; ++i) {
      const uint64_t product0 = static_cast<uint64_t>(kMultiplier0) * blocks.x[0][i];
      const uint64_t product1 = static_cast<uint64_t>(kMultiplier1) * blocks.x[2][i];
      blocks.x[0][i] = static_cast<uint32_t>(product1 >> 32) ^ blocks.x[1][i] ^ key0;
      blocks.x[2][i] = static_cast<uint32_t>(product0 >> 32) ^ blocks.x[3][i] ^ key1;
      blocks.x[1][i] = static_cast<uint32_t>(product1);
      blocks.x[3][i] = static_cast<uint32_t>(product0);
    }
    key0 += kWeyl0;
    key1 += kWeyl1;
  }
}

// ln x for normal positive x, to 1e-7: x = m 2^e with m in [√½, √2), ln m by the series of
// artanh((m - 1)/(m + 1)), whose argument is below 0.172.
inline float LogOf(float x) {
  const auto bits = std::bit_cast<int32_t>(x) - 0x3f3504f3;  // √½
  const int32_t exponent = bits >> 23;
  const float m = std::bit_cast<float>((bits & 0x007fffff) + 0x3f3504f3);
  const float s = (m - 1.0f) / (m + 1.0f);
  const float s2 = s * s;
  const float series =
      s * (2.0f + s2 * (0.66666667f + s2 * (0.4f + s2 * (0.28571429f + s2 * 0.22222222f))));
  return static_cast<float>(exponent) * 0.69314718f + series;
}

inline float Choose(bool first, float a, float b) {
  return first ? a : b;
}

FENESTRA_WIDE void Normals(const uint32_t* words, float* normals, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const uint32_t word = words[i];
    // The lower half of the distribution is computed and the lowest bit mirrors it: the tail keeps
    // all bits that a float near 1 would lose.
    const float p_raw = (static_cast<float>(static_cast<int32_t>(word >> 1)) + 0.5f) * 0x1p-32f;
    const float p = Choose(p_raw < 0.5f, p_raw, 0.5f);
    const float q = p - 0.5f;
    const float c = 0.180625f - q * q;
    const float central =
        q *
        (((5.9109374720e+01f * c + 1.5929113202e+02f) * c + 5.0434271938e+01f) * c +
         3.3871327179e+00f) /
        (((6.7187563600e+01f * c + 7.8757757664e+01f) * c + 1.7895169469e+01f) * c + 1.0f);
    const float root = std::sqrt(-LogOf(p));
    const float t = root - 1.6f;  // p > 2^-34: the root stays below 5.
    const float tail = -(((1.7023821103e-01f * t + 1.3067284816e+00f) * t + 2.7568153900e+00f) * t +
                         1.4234372777e+00f) /
                       ((1.2021132975e-01f * t + 7.3700164250e-01f) * t + 1.0f);
    const float x = Choose(q >= -0.425f, central, tail);
    normals[i] = Choose((word & 1u) != 0, -x, x);
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

void FillPhiloxWords(uint64_t key, uint32_t use, uint64_t first_block, std::span<uint32_t> words) {
  Blocks blocks;
  constexpr size_t kWords = 4 * kBlocks;
  for (size_t first = 0; first < words.size(); first += kWords) {
    Encipher(key, use, first_block + first / 4, blocks);
    const size_t count = std::min(kWords, words.size() - first);
    for (size_t i = 0; i < count; ++i) words[first + i] = blocks.x[i % 4][i / 4];
  }
}

void NormalsOfWords(std::span<const uint32_t> words, std::span<float> normals) {
  FENESTRA_CHECK(words.size() == normals.size(), "one normal for each word");
  Normals(words.data(), normals.data(), normals.size());
}

}  // namespace fenestra
