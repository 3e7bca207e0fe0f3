#include "experiments/run/shards.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

std::vector<TrialKey> Grid(int cells, int trials) {
  std::vector<TrialKey> keys;
  for (int cell = 0; cell < cells; ++cell) {
    for (int trial = 0; trial < trials; ++trial) keys.push_back({cell, trial});
  }
  return keys;
}

TEST(ShardTest, SharesHaveEveryTrialOnceAndDifferByOneAtMost) {
  for (const int count : {1, 2, 3, 7, 16, 100}) {
    const std::vector<TrialKey> all = Grid(5, 9);
    std::vector<TrialKey> joined;
    for (int index = 1; index <= count; ++index) {
      const std::vector<TrialKey> share = Shard{index, count}.Of(all);
      EXPECT_GE(share.size(), all.size() / static_cast<size_t>(count));
      EXPECT_LE(share.size(), all.size() / static_cast<size_t>(count) + 1);
      EXPECT_TRUE(std::is_sorted(share.begin(), share.end()));
      joined.insert(joined.end(), share.begin(), share.end());
    }
    std::sort(joined.begin(), joined.end());
    EXPECT_EQ(joined, all);
  }
}

// Cells may take very different times: each share has its part of each.
TEST(ShardTest, EveryShareHasItsPartOfEveryCell) {
  for (int index = 1; index <= 4; ++index) {
    const std::vector<TrialKey> share = Shard{index, 4}.Of(Grid(6, 30));
    for (int cell = 0; cell < 6; ++cell) {
      const auto in_cell = [cell](const TrialKey& key) { return key.cell == cell; };
      const auto count = std::count_if(share.begin(), share.end(), in_cell);
      EXPECT_GE(count, 7);
      EXPECT_LE(count, 8);
    }
  }
}

TEST(ShardTest, TextsAreReadStrictly) {
  EXPECT_EQ(Shard::Parse("2/8"), (Shard{2, 8}));
  EXPECT_EQ(Shard::Parse(Shard{3, 5}.ToString()), (Shard{3, 5}));
  for (const char* text : {"", "2", "0/8", "9/8", "-1/8", "2/0", "2/8x", "2/ 8", "2:8", "1.5/3",
                           "1/99999999999", "/8", "2/"}) {
    EXPECT_THROW(Shard::Parse(text), InputError) << text;
  }
}

}  // namespace
}  // namespace fenestra
