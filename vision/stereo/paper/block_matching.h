#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "vision/stereo/paper/matched_patch.h"
#include "vision/stereo/rectification.h"

namespace fenestra {

struct BlockMatchingSettings {
  int window_px;              ///< Side of the square SAD block; odd.
  int nearest_disparity_px;   ///< Largest disparity that is searched.
  int farthest_disparity_px;  ///< Smallest disparity that is searched; at least 0.
  int uniqueness_percent;  ///< The best SAD must beat all others but its neighbours by this much.
  int texture_threshold;   ///< Least sum over the block of the prefiltered image's contrast.
  int speckle_area_px;     ///< Smaller patches of continuous disparity are dropped.
  double speckle_step_px;  ///< Disparity counts as continuous where it changes by less.
  bool left_right_check;   ///< Drops pixels whose match is matched to another pixel.
};

/// Runs cv::StereoBM on the padded pair and nothing else. Returns disparities in sixteenths of a
/// pixel, or less than 16 `farthest_disparity_px` where there is none. This is the first step of
/// MatchBlocks and the reference for its run time.
cv::Mat1s MatchPadded(const RectifiedPair& pair, const BlockMatchingSettings& settings);

/// Computes the disparity d [px] of each pixel of the left image, to 1/16 px; 0 where there is
/// none.
///
/// For each left pixel this is the disparity with the least sum of absolute differences (SAD) over
/// a square block, after a horizontal Sobel filter clipped at ±31, refined by a parabola through
/// the three sums around the minimum. K. Konolige, "Small vision systems: hardware and
/// implementation", ISRR 1997; Bradski and Kaehler 2008, ch. 12; cv::StereoBM.
///
/// cv::StereoBM gives no result for the left image's first columns, as many as the largest
/// disparity, nor for a rim of half a block. The pair is padded by that much on every side and the
/// result is cropped, so that it covers the whole left image. Matches whose left pixel is outside
/// `left_seen` or whose right pixel is outside `right_seen` are dropped.
cv::Mat1f MatchBlocks(const RectifiedPair& pair, const cv::Mat1b& left_seen,
                      const cv::Mat1b& right_seen, const BlockMatchingSettings& settings);

/// Matches the rows of the tallest patches again, only near the disparities of these patches.
///
/// The reason is that the left and the right side of a frame look alike. The right side of a frame
/// of width s at disparity d resembles, besides itself, the left side of the right image at
/// disparity
///
///     d' = d (1 + s / B),
///
/// so that wherever d' is within the search range (far frames, for a search that begins near) the
/// uniqueness test rightly drops the right side of the frame. The left side has no such double if s
/// > B, since its d' = d (1 - s / B) is negative. Its depth makes the right side unique again:
/// within d (1 ± kReach) there is no double of a frame wider than kReach B. A frame narrower than
/// the baseline has doubles on both sides.
///
/// This is a form of coarse-to-fine search and a departure from Bradski and Kaehler 2008, who
/// search once.
///
/// `disparity` is the result of the first search with the same pair and settings. New matches
/// replace old ones; those near a taller patch have precedence. A patch is skipped if d (1 + s / B)
/// is beyond the search range for the narrowest frame, s / B = `narrowest_in_baselines`. Returns
/// nullopt if all patches are skipped.
std::optional<cv::Mat1f> MatchAgainNearPatches(
    const RectifiedPair& pair, const cv::Mat1b& left_seen, const cv::Mat1b& right_seen,
    const BlockMatchingSettings& settings, const cv::Mat1f& disparity,
    const std::vector<MatchedPatch>& patches, double narrowest_in_baselines);

}  // namespace fenestra
