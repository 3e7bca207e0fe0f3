#pragma once

#include <opencv2/core.hpp>

#include "vision/stereo/rectification.h"

namespace fenestra {

struct BlockMatchingSettings {
  int window_px;              ///< Side of the square SAD window; odd.
  int nearest_disparity_px;   ///< Largest disparity that is searched.
  int farthest_disparity_px;  ///< Smallest disparity that is searched; at least 0.
  int uniqueness_percent;     ///< The best SAD must beat all but its neighbours by so much.
  int texture_threshold;      ///< Least sum over the window of the prefiltered image's contrast.
  int speckle_area_px;        ///< Smaller patches of continuous disparity are dropped.
  double speckle_step_px;     ///< Disparity is continuous where it changes by less than this.
  bool left_right_check;      ///< Drop pixels whose match is matched to another pixel.
};

/// cv::StereoBM on the padded pair, and nothing else: disparities in its sixteenths, or less than
/// 16 `farthest_disparity_px` for none. What MatchBlocks begins with, and what its time is measured
/// against.
cv::Mat1s MatchPadded(const RectifiedPair& pair, const BlockMatchingSettings& settings);

/// Disparity d [px] of each pixel of the left image, to 1/16 px; 0 where there is none.
///
/// For each left pixel the disparity with the least sum of absolute differences over a square
/// window, after a horizontal Sobel filter clipped at ±31, with a parabola through the three
/// sums around the minimum. K. Konolige, "Small vision systems: hardware and implementation", ISRR
/// 1997; Bradski and Kaehler 2008, ch. 12; cv::StereoBM.
///
/// cv::StereoBM says nothing about the left image's first columns, as many as the largest
/// disparity, nor about a rim of half a window. The pair is padded by as much on every side, and
/// the result cropped, so that it covers the whole left image. A match whose right pixel lies
/// outside the right image's `right_seen`, or whose left pixel outside `left_seen`, is dropped.
cv::Mat1f MatchBlocks(const RectifiedPair& pair, const cv::Mat1b& left_seen,
                      const cv::Mat1b& right_seen, const BlockMatchingSettings& settings);

}  // namespace fenestra
