#include "sim/structured_light/dot_pattern.h"

#include <cmath>
#include <vector>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

constexpr int kCells = DotPattern::kTileWidth * DotPattern::kTileHeight;

// Each dot is put where fewest others are, of so many places drawn at random.
constexpr int kCandidates = 40;
// How far dots feel each other [cells].
constexpr double kRange = 2.0;
constexpr int kReach = 8;

int Wrapped(int i, int size) {
  const int rest = i % size;
  return rest < 0 ? rest + size : rest;
}

}  // namespace

size_t DotPattern::Index(int column, int row) {
  return static_cast<size_t>(Wrapped(row, kTileHeight) * kTileWidth + Wrapped(column, kTileWidth));
}

DotPattern::DotPattern() {
  std::vector<double> crowding(static_cast<size_t>(kCells), 0.0);
  const RandomStream stream = RandomStream(0).Child("dot_pattern");
  uint64_t draw = 0;
  for (int dot = 0; dot < kDots; ++dot) {
    int best = -1;
    for (int i = 0; i < kCandidates; ++i) {
      const int cell = static_cast<int>(stream.Uniform(draw++) * kCells);
      if (dots_[static_cast<size_t>(cell)]) continue;
      if (best < 0 || crowding[static_cast<size_t>(cell)] < crowding[static_cast<size_t>(best)]) {
        best = cell;
      }
    }
    if (best < 0) {
      --dot;
      continue;
    }
    dots_[static_cast<size_t>(best)] = true;
    for (int y = -kReach; y <= kReach; ++y) {
      for (int x = -kReach; x <= kReach; ++x) {
        crowding[Index(best % kTileWidth + x, best / kTileWidth + y)] +=
            std::exp(-0.5 * (x * x + y * y) / (kRange * kRange));
      }
    }
  }
}

}  // namespace fenestra
