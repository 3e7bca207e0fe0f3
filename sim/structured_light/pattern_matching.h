#pragma once

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "sim/structured_light/disparity.h"
#include "sim/structured_light/dot_pattern.h"

namespace fenestra {

/// The sensor's search for its pattern in an infra-red image. Blocks of 9 x 9 or 9 x 7 pixels, a
/// search over 64 px and results in 1/8 px are what ROS kinect_calibration/technical infers.
struct PatternMatchingOptions {
  /// Disparities from that of infinite distance to this are searched, in pixels of a 640-wide
  /// image, and farther if the nearest distance of the range demands it, as it does in near mode.
  /// Surfaces beyond the range are thus recognised, instead of being mistaken for others.
  double search_px = 64.0;
  int block_width_px = 9;   ///< Odd, 3 to 15.
  int block_height_px = 9;  ///< Odd, 3 to 15.
  /// A match counts if its correlation coefficient is at least this. By chance, coefficients of
  /// blocks of 81 pixels have a standard deviation of 1/9. Blocks that hold a part of the
  /// foreground and a part of its shadow correlate with a part of their dots: the value is chosen
  /// so that shadows are 3 to 4 px of 640 narrower than geometry says, as recorded.
  double least_correlation = 0.45;

  /// The largest disparity that is searched [px of a 640-wide image]: with room for noise, and for
  /// the neighbours that the vertex needs.
  double SearchEnd(const DisparityRange& range) const {
    constexpr double kRoom_px = 2.0;
    return std::max(search_px, range.focal_times_baseline / range.nearest_m + kRoom_px);
  }
};

/// Throws InputError with all faults.
void Validate(const PatternMatchingOptions& options);

/// The place of each pixel's block in the memorised pattern: disparities [px], NaN without match.
struct PatternMatches {
  cv::Mat1f disparity_px;
  cv::Mat1f correlation;  ///< Correlation of the best place; -1 where none could be tried.
};

/// Finds, for the block I around each pixel (u, v) of an infra-red image, the disparity d that
/// maximises its correlation coefficient with the pattern R at u - d,
///
///     ZNCC(d) = cov(I, R_d) / √(var I var R_d),
///
/// over steps of half a pixel, and the vertex by the best and its neighbours (SubpixelVertex).
class PatternMatcher {
 public:
  /// Enough for images 4096 px wide in near mode.
  static constexpr double kMostDisparity_px = 1000.0;

  /// For images of this size, disparities from least to most [px]; 0 ≤ least < most ≤ 1000.
  PatternMatcher(const PatternMatchingOptions& options, const SampledPattern& pattern,
                 cv::Size image, double least_px, double most_px);

  /// Matches an image of 10 bits. Blocks that leave it are not matched. Of the rows of blocks, only
  /// every `row_step`th is matched, beginning with the first.
  PatternMatches Match(const cv::Mat1w& image, int row_step = 1) const;

  /// Best scores of the pixels of a row while disparities are tried one after the other.
  struct Best {
    float* score;   ///< The best one,
    float* step;    ///< where it was, in half pixels,
    float* before;  ///< and the scores next to it.
    float* after;
    float* last;  ///< The score of the step before.
  };

 private:
  /// The disparity at which pixel i of a row matches, less the least disparity [px].
  std::optional<float> Accept(const Best& best, int i) const;

  /// The pattern displaced by half a pixel (phase 1) or not (phase 0), and its blocks' statistics;
  /// column i is the pattern's column i - most.
  struct Phase {
    cv::Mat1i values;          ///< Up to 255.
    cv::Mat1i sums;            ///< Over blocks.
    cv::Mat1f inverse_spread;  ///< 1/√(n Σ R² - (Σ R)²) over blocks.
  };

  PatternMatchingOptions options_;
  SubpixelVertex vertex_;
  cv::Size size_;
  int least_;
  int most_;
  std::array<Phase, 2> phases_;
};

}  // namespace fenestra
