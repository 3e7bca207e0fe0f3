#include "sim/structured_light/dot_pattern.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

constexpr int kCells = DotPattern::kTileWidth * DotPattern::kTileHeight;

// Number of places that are drawn for each dot, which is put where the fewest others are near.
constexpr int kCandidates = 40;
// Distance up to which dots repel each other [cells].
constexpr double kRange = 2.0;
constexpr int kReach = 8;

int Wrapped(int i, int size) {
  const int rest = i % size;
  return rest < 0 ? rest + size : rest;
}

// The mean over a pixel, `offset` from a dot's centre, of a Gaussian of unit sum along one axis.
double MeanOverPixel(double offset, double sigma_px) {
  const double scale = 1.0 / (sigma_px * std::numbers::sqrt2);
  return 0.5 * (std::erf((offset + 0.5) * scale) - std::erf((offset - 0.5) * scale));
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

SampledPattern::SampledPattern(double dot_sigma_px) {
  const double peak = MeanOverPixel(0.0, dot_sigma_px);
  for (size_t i = 0; i < spread_.size(); ++i) {
    const double offset = static_cast<double>(i) / kStepsPerCell - (kReach + 1);
    spread_[i] = static_cast<float>(MeanOverPixel(offset, dot_sigma_px) / peak);
  }
  static const DotPattern pattern;
  gathered_ = cv::Mat1f::zeros(DotPattern::kTileHeight, DotPattern::kTileWidth + 2 * kReach + 1);
  for (int row = 0; row < gathered_.rows; ++row) {
    for (int column = 0; column < gathered_.cols; ++column) {
      for (int j = -kReach; j <= kReach; ++j) {
        if (pattern.HasDot(column, row + j)) gathered_(row, column) += SpreadAt(j);
      }
    }
  }
}

float SampledPattern::SpreadAt(double offset) const {
  return spread_[static_cast<size_t>(std::lround((offset + (kReach + 1)) * kStepsPerCell))];
}

float SampledPattern::At(double column, int row) const {
  const auto nearest = static_cast<int>(std::floor(column + 0.5));
  const double offset = column - nearest;
  int first = (nearest - kReach) % DotPattern::kTileWidth;
  if (first < 0) first += DotPattern::kTileWidth;
  int tile_row = row % DotPattern::kTileHeight;
  if (tile_row < 0) tile_row += DotPattern::kTileHeight;
  const float* cells = gathered_[tile_row] + first;
  float sum = 0.0f;
  for (int i = 0; i <= 2 * kReach; ++i) sum += SpreadAt(offset - (i - kReach)) * cells[i];
  return sum;
}

cv::Mat1f SampledPattern::Displaced(double displacement) const {
  // All columns lie at the same offset from their cells, so that one kernel serves the whole tile.
  const auto whole = static_cast<int>(std::floor(0.5 - displacement));
  const double offset = -displacement - whole;
  int first = (whole - kReach) % DotPattern::kTileWidth;
  if (first < 0) first += DotPattern::kTileWidth;
  cv::Mat1f displaced = cv::Mat1f::zeros(DotPattern::kTileHeight, DotPattern::kTileWidth);
  for (int i = 0; i <= 2 * kReach; ++i) {
    const float weight = SpreadAt(offset - (i - kReach));
    for (int row = 0; row < displaced.rows; ++row) {
      for (int column = 0; column < displaced.cols; ++column) {
        displaced(row, column) +=
            weight * gathered_(row, (first + column) % DotPattern::kTileWidth + i);
      }
    }
  }
  return displaced;
}

SampledPattern::Moments SampledPattern::MomentsAt(double displacement) const {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(Displaced(displacement), mean, deviation);
  return {mean[0], deviation[0] * deviation[0]};
}

double SampledPattern::Correlation(double displacement_a, double displacement_b) const {
  const cv::Mat1f pattern_a = Displaced(displacement_a);
  const cv::Mat1f pattern_b = Displaced(displacement_b);
  const double products = pattern_a.dot(pattern_b) / static_cast<double>(pattern_a.total());
  const Moments a = MomentsAt(displacement_a);
  const Moments b = MomentsAt(displacement_b);
  return (products - a.mean * b.mean) / std::sqrt(a.variance * b.variance);
}

}  // namespace fenestra
