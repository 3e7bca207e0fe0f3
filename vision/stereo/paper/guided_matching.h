#pragma once

#include <optional>

#include "vision/stereo/paper/block_matching.h"
#include "vision/stereo/paper/matched_patch.h"

namespace fenestra {

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
