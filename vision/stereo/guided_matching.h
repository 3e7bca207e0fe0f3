#pragma once

#include <optional>

#include "vision/stereo/block_matching.h"
#include "vision/stereo/matched_patch.h"

namespace fenestra {

/// Matches the rows of the tallest patches once more, near the disparities of these patches only.
///
/// Why: the left and the right side of a frame look alike. The right side of a frame of width s
/// at disparity d resembles, besides itself, the left side of the right image at disparity
///
///     d' = d (1 + s / B),
///
/// so that wherever d' is within the search range (far frames, for a search that begins near)
/// the uniqueness test drops the right side of the frame, rightly. The left side has no such
/// double for s > B, as its d' = d (1 - s / B) is negative. What it tells of the depth makes the
/// right side unique again: within d (1 ± kReach) there is no double of a frame wider than
/// kReach B. A frame narrower than the baseline has doubles on both sides.
///
/// A departure from Bradski and Kaehler 2008, who search once; a form of coarse-to-fine search.
///
/// `disparity` is the result of the first search with the same pair and settings; new matches
/// replace old ones, those near a taller patch first. Nothing is done for a patch with d (1 + s /
/// B) beyond the search range for the narrowest frame, s / B = `narrowest_in_baselines`; nullopt if
/// nothing is done at all.
std::optional<cv::Mat1f> MatchAgainNearPatches(
    const RectifiedPair& pair, const cv::Mat1b& left_seen, const cv::Mat1b& right_seen,
    const BlockMatchingSettings& settings, const cv::Mat1f& disparity,
    const std::vector<MatchedPatch>& patches, double narrowest_in_baselines);

}  // namespace fenestra
