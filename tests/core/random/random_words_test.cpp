#include "core/random/random_stream.h"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <vector>

namespace fenestra {
namespace {

TEST(RandomWordsTest, NormalsOfWordsAreBoostsQuantiles) {
  const boost::math::normal normal;
  for (double fraction = 1e-9; fraction < 1.0; fraction *= 1.1) {
    const auto half = static_cast<uint32_t>(fraction * 0x1p31);
    // Converted to single precision as a float's 24 bits allow.
    const float p = std::min((static_cast<float>(half) + 0.5f) * 0x1p-32f, 0.5f);
    const double expected = boost::math::quantile(normal, double{p});
    const std::array<uint32_t, 2> words = {2 * half, 2 * half + 1};
    std::array<float, 2> normals;
    NormalsOfWords(words, normals);
    // PPND7 is good to one part in 10^7; the logarithm and the last float operations add to it.
    EXPECT_NEAR(normals[0], expected, 1e-6 * std::abs(expected) + 1e-7) << p;
    EXPECT_EQ(normals[1], -normals[0]);
  }
}

TEST(RandomWordsTest, WordsAreThoseOfRandom123) {
  constexpr uint64_t kKey = 0x0123456789abcdefu;
  constexpr uint64_t kFirst = 0xfffffffeu;  // The counter carries into its second word.
  std::vector<uint32_t> words(203);
  FillPhiloxWords(kKey, 2, kFirst, words);
  for (size_t i = 0; i < words.size(); ++i) {
    const uint64_t block = kFirst + i / 4;
    const r123::Philox4x32::ctr_type expected = r123::Philox4x32()(
        {{static_cast<uint32_t>(block), static_cast<uint32_t>(block >> 32), 0, 2}},
        {{static_cast<uint32_t>(kKey), static_cast<uint32_t>(kKey >> 32)}});
    ASSERT_EQ(words[i], expected.v[i % 4]) << i;
  }
}

}  // namespace
}  // namespace fenestra
