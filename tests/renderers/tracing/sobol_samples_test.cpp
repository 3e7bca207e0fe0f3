#include "renderers/tracing/sobol_samples.h"

#include <gtest/gtest.h>

#include <set>

namespace fenestra {
namespace {

TEST(SobolSamples, StayStratifiedUnderScrambling) {
  for (const uint32_t pixel : {0u, 1u, 752u * 480u}) {
    const SobolPoint scramble = ImageScramble(99).OfPixel(pixel);
    for (const int bits_x : {0, 1, 4, 7, 8}) {  // Shapes of elementary intervals of area 1/256.
      std::set<std::pair<uint64_t, uint64_t>> intervals;
      for (size_t i = 0; i < kMostPixelSamples; ++i) {
        const uint64_t x = OwenScrambled(kSobolTable.x[i], scramble.x);
        const uint64_t y = OwenScrambled(kSobolTable.y[i], scramble.y);
        intervals.insert({x >> (32 - bits_x), y >> (24 + bits_x)});
      }
      EXPECT_EQ(intervals.size(), 256u) << bits_x;
    }
  }
}

}  // namespace
}  // namespace fenestra
