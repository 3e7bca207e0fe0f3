#include "sim/structured_light/dot_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fenestra {
namespace {

constexpr int kWindow = 9;

template <typename Visit>
void VisitCells(Visit visit) {
  for (int row = 0; row < DotPattern::kTileHeight; ++row) {
    for (int column = 0; column < DotPattern::kTileWidth; ++column) visit(column, row);
  }
}

TEST(DotPatternTest, HasTheDensityThatWasMeasured) {
  const DotPattern pattern;
  int dots = 0;
  VisitCells([&](int column, int row) { dots += pattern.HasDot(column, row) ? 1 : 0; });
  EXPECT_EQ(dots, 3861);
}

TEST(DotPatternTest, EveryWindowHasDotsToRecogniseItBy) {
  const DotPattern pattern;
  int fewest = kWindow * kWindow;
  int most = 0;
  VisitCells([&](int column, int row) {
    int dots = 0;
    for (int j = 0; j < kWindow; ++j) {
      for (int i = 0; i < kWindow; ++i) dots += pattern.HasDot(column + i, row + j) ? 1 : 0;
    }
    fewest = std::min(fewest, dots);
    most = std::max(most, dots);
  });
  EXPECT_GE(fewest, 5);
  EXPECT_LE(most, 13);
}

TEST(DotPatternTest, WindowsAreUniqueAlongTheirRowWithinTheSearch) {
  // Near mode searches over 94 px, with room for noise.
  constexpr int kSearch = 105;
  const DotPattern pattern;
  int least = kWindow * kWindow;
  VisitCells([&](int column, int row) {
    for (int shift = 1; shift <= kSearch; ++shift) {
      int differing = 0;
      for (int j = 0; j < kWindow; ++j) {
        for (int i = 0; i < kWindow; ++i) {
          differing +=
              pattern.HasDot(column + i, row + j) != pattern.HasDot(column + i + shift, row + j)
                  ? 1
                  : 0;
        }
      }
      least = std::min(least, differing);
    }
  });
  EXPECT_GE(least, 4);
}

TEST(DotPatternTest, TilesRepeat) {
  const DotPattern pattern;
  VisitCells([&](int column, int row) {
    EXPECT_EQ(pattern.HasDot(column, row), pattern.HasDot(column - 211, row + 2 * 165));
  });
}

}  // namespace
}  // namespace fenestra
