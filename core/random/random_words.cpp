#include "core/random/random_words.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/system/check.h"
#include "core/system/wide.h"

namespace fenestra {
namespace {

// Salmon et al. 2011.
constexpr uint32_t kMultiplier0 = 0xD2511F53;
constexpr uint32_t kMultiplier1 = 0xCD9E8D57;
constexpr uint32_t kWeyl0 = 0x9E3779B9;
constexpr uint32_t kWeyl1 = 0xBB67AE85;
constexpr int kRounds = 10;

// Blocks that are enciphered side by side.
constexpr int kBlocks = 16;

struct Blocks {
  alignas(64) uint32_t x[4][kBlocks];
};

FENESTRA_WIDE void Encipher(uint64_t key, uint32_t use, uint64_t first_block, Blocks& blocks) {
  for (int i = 0; i < kBlocks; ++i) {
    const uint64_t counter = first_block + static_cast<uint64_t>(i);
    blocks.x[0][i] = static_cast<uint32_t>(counter);
    blocks.x[1][i] = static_cast<uint32_t>(counter >> 32);
    blocks.x[2][i] = 0;
    blocks.x[3][i] = use;
  }
  auto key0 = static_cast<uint32_t>(key);
  auto key1 = static_cast<uint32_t>(key >> 32);
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < kBlocks; ++i) {
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
