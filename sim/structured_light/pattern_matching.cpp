#include "sim/structured_light/pattern_matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/io/faults.h"
#include "core/system/check.h"
#include "core/system/wide.h"

namespace fenestra {
namespace {

// Grey values of the memorised pattern: a dot's peak is half of this, for dots may overlap.
constexpr float kPatternScale = 127.0f;

// Values below any correlation, and far from any step.
constexpr float kNoScore = -100.0f;

// Column sums of products move down by one row.
FENESTRA_WIDE void MoveDown(const int* in_image, const int* in_pattern, const int* out_image,
                            const int* out_pattern, int* sums, int count) {
  for (int u = 0; u < count; ++u) {
    sums[u] += in_image[u] * in_pattern[u] - out_image[u] * out_pattern[u];
  }
}

FENESTRA_WIDE void AddProducts(const int* image, const int* pattern, int* sums, int count) {
  for (int u = 0; u < count; ++u) sums[u] += image[u] * pattern[u];
}

// sums[u] = in[u] + … + in[u + block - 1].
FENESTRA_WIDE void AddShifts(const int* in, int block, int* sums, int count) {
  if (block == 9) {  // The sensor's own, in one pass.
    for (int u = 0; u < count; ++u) {
      sums[u] = in[u] + in[u + 1] + in[u + 2] + in[u + 3] + in[u + 4] + in[u + 5] + in[u + 6] +
                in[u + 7] + in[u + 8];
    }
    return;
  }
  for (int u = 0; u < count; ++u) sums[u] = in[u];
  for (int i = 1; i < block; ++i) {
    for (int u = 0; u < count; ++u) sums[u] += in[u + i];
  }
}

// The correlation coefficients of blocks with n pixels, by their sums and 1/√(n Σ x² - (Σ x)²).
FENESTRA_WIDE void Correlate(const int* products, float pixels, const int* image_sums,
                             const float* image_inverse_spread, const int* pattern_sums,
                             const float* pattern_inverse_spread, float* scores, int count) {
  for (int u = 0; u < count; ++u) {
    const float covariance =
        pixels * static_cast<float>(products[u]) -
        static_cast<float>(image_sums[u]) * static_cast<float>(pattern_sums[u]);
    scores[u] = covariance * (image_inverse_spread[u] * pattern_inverse_spread[u]);
  }
}

// All bits are set if the condition holds.
inline int32_t MaskOf(bool holds) {
  return -static_cast<int32_t>(holds);
}

// By bits: the compiler makes branches of nested choices, and no vectors of branches.
inline float Choose(int32_t mask, float a, float b) {
  return std::bit_cast<float>((std::bit_cast<int32_t>(a) & mask) |
                              (std::bit_cast<int32_t>(b) & ~mask));
}

// Everything is loaded before anything is stored, and no two of the arrays overlap.
FENESTRA_WIDE void Update(const float* __restrict scores, float step, float* __restrict best_score,
                          float* __restrict best_step, float* __restrict best_before,
                          float* __restrict best_after, float* __restrict last, int count) {
  for (int u = 0; u < count; ++u) {
    const float score = scores[u];
    const float old_score = best_score[u];
    const float distance = step - best_step[u];
    const int32_t better = MaskOf(score > old_score);
    const float after = Choose(MaskOf(distance < 1.5f), score, best_after[u]);
    best_after[u] = Choose(better, kNoScore, after);
    best_before[u] = Choose(better, last[u], best_before[u]);
    best_step[u] = Choose(better, step, step - distance);
    best_score[u] = Choose(better, score, old_score);
    last[u] = score;
  }
}

// Sums over blocks, and 1/√(n Σ x² - (Σ x)²), at the blocks' centres; 0 where a block is flat or
// leaves the image.
void BlockStatistics(const cv::Mat1i& image, int reach_u, int reach_v, cv::Mat1i& sums,
                     cv::Mat1f& inverse_spread) {
  sums = cv::Mat1i::zeros(image.size());
  inverse_spread = cv::Mat1f::zeros(image.size());
  const double pixels = (2 * reach_u + 1) * (2 * reach_v + 1);
  cv::Mat1d sum;
  cv::Mat1d squares;
  cv::integral(cv::Mat1f(image), sum, squares, CV_64F, CV_64F);
  for (int v = reach_v; v + reach_v < image.rows; ++v) {
    for (int u = reach_u; u + reach_u < image.cols; ++u) {
      const auto box = [&](const cv::Mat1d& integral) {
        return integral(v + reach_v + 1, u + reach_u + 1) - integral(v - reach_v, u + reach_u + 1) -
               integral(v + reach_v + 1, u - reach_u) + integral(v - reach_v, u - reach_u);
      };
      const double s = box(sum);
      const double spread2 = pixels * box(squares) - s * s;
      sums(v, u) = static_cast<int>(std::lround(s));
      if (spread2 > 0.5) inverse_spread(v, u) = static_cast<float>(1.0 / std::sqrt(spread2));
    }
  }
}

}  // namespace

void Validate(const PatternMatchingOptions& o) {
  Faults faults("speckle matching");
  for (const int side : {o.block_width_px, o.block_height_px}) {
    faults.Require(
        side >= 3 && side <= 15 && side % 2 == 1,
        fmt::format("the window's sides must be odd numbers from 3 to 15 px, not {}", side));
  }
  faults.Require(o.search_px >= 1.0 && o.search_px <= 200.0, "the search must be over 1 to 200 px");
  faults.Require(o.least_correlation > 0.0 && o.least_correlation < 1.0,
                 "the least correlation must lie between 0 and 1");
  faults.ThrowIfAny();
}

PatternMatcher::PatternMatcher(const PatternMatchingOptions& options, const SampledPattern& pattern,
                               cv::Size image, double least_px, double most_px)
    : options_(Validated(options)),
      vertex_(pattern),
      size_(image),
      least_(static_cast<int>(std::floor(least_px))),
      most_(static_cast<int>(std::ceil(most_px))) {
  FENESTRA_CHECK(0 <= least_ && least_ < most_ && most_ <= kMostDisparity_px,
                 "disparities from 0 to 1000 px");
  for (int phase = 0; phase < 2; ++phase) {
    Phase& p = phases_[phase];
    p.values = cv::Mat1i(image.height, image.width + most_);
    for (int v = 0; v < p.values.rows; ++v) {
      for (int i = 0; i < p.values.cols; ++i) {
        p.values(v, i) =
            static_cast<int>(std::lround(kPatternScale * pattern.At(i - most_ - 0.5 * phase, v)));
      }
    }
    BlockStatistics(p.values, options.block_width_px / 2, options.block_height_px / 2, p.sums,
                    p.inverse_spread);
  }
}

PatternMatches PatternMatcher::Match(const cv::Mat1w& image, int row_step) const {
  FENESTRA_CHECK(row_step >= 1, "rows are counted in positive steps");
  FENESTRA_CHECK(image.size() == size_, "the image must have the matcher's size");
  const int reach_u = options_.block_width_px / 2;
  const int reach_v = options_.block_height_px / 2;
  const int width = size_.width;
  cv::Mat1i grey;
  image.convertTo(grey, CV_32S);
  cv::Mat1i sums;
  cv::Mat1f inverse_spread;
  BlockStatistics(grey, reach_u, reach_v, sums, inverse_spread);

  PatternMatches matches{cv::Mat1f(size_, std::numeric_limits<float>::quiet_NaN()),
                         cv::Mat1f(size_, -1.0f)};
  const int inside = width - 2 * reach_u;
  if (inside <= 0 || size_.height <= 2 * reach_v) return matches;

  // Matching goes row by row, so that the scores of a row's pixels stay in the cache while all
  // disparities are tried. Disparity least + k/2 is the pattern at u - d; phase 1 has it half a
  // pixel further.
  const int steps = 2 * (most_ - least_);
  const auto pattern_row = [&](int k, const cv::Mat& of, int v) {
    return of.ptr<int>(v) + most_ - least_ - k / 2;
  };
  const auto pixels = static_cast<float>(options_.block_width_px * options_.block_height_px);
  cv::Mat1i columns = cv::Mat1i::zeros(steps + 1, width);
  for (int k = 0; k <= steps; ++k) {
    for (int v = 0; v <= 2 * reach_v; ++v) {
      AddProducts(grey[v], pattern_row(k, phases_[k % 2].values, v), columns[k], width);
    }
  }
  std::vector<int> products(static_cast<size_t>(inside));
  std::vector<float> scores(products.size());
  for (int v = reach_v; v + reach_v < size_.height; ++v) {
    cv::Mat1f memory(5, inside, kNoScore);
    const Best best{.score = memory[0],
                    .step = memory[1],
                    .before = memory[2],
                    .after = memory[3],
                    .last = memory[4]};
    const bool is_wanted = (v - reach_v) % row_step == 0;
    for (int k = 0; k <= steps; ++k) {
      const Phase& phase = phases_[k % 2];
      if (v > reach_v) {
        MoveDown(grey[v + reach_v], pattern_row(k, phase.values, v + reach_v),
                 grey[v - reach_v - 1], pattern_row(k, phase.values, v - reach_v - 1), columns[k],
                 width);
      }
      if (!is_wanted) continue;
      AddShifts(columns[k], 2 * reach_u + 1, products.data(), inside);
      const int shift = most_ - least_ - k / 2 + reach_u;
      Correlate(products.data(), pixels, sums[v] + reach_u, inverse_spread[v] + reach_u,
                phase.sums[v] + shift, phase.inverse_spread[v] + shift, scores.data(), inside);
      Update(scores.data(), static_cast<float>(k), best.score, best.step, best.before, best.after,
             best.last, inside);
    }
    if (!is_wanted) continue;
    for (int i = 0; i < inside; ++i) {
      matches.correlation(v, i + reach_u) = std::max(best.score[i], -1.0f);
      if (const auto place_px = Accept(best, i)) {
        matches.disparity_px(v, i + reach_u) = static_cast<float>(least_) + *place_px;
      }
    }
  }
  return matches;
}

std::optional<float> PatternMatcher::Accept(const Best& best, int i) const {
  const float score = best.score[i];
  const float before = best.before[i];
  const float after = best.after[i];
  if (score < static_cast<float>(options_.least_correlation)) return std::nullopt;
  // The first and the last step have no neighbour on one side.
  if (before == kNoScore || after == kNoScore) return std::nullopt;
  const bool is_whole_pixel = static_cast<int>(best.step[i]) % 2 == 0;
  return 0.5f * best.step[i] + vertex_.Offset(is_whole_pixel, before, score, after);
}

}  // namespace fenestra
