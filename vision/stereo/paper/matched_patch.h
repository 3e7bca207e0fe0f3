#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/paper/disparity_plane.h"

namespace fenestra {

/// A connected region of matched pixels whose disparities vary without a gap.
struct MatchedPatch {
  cv::Rect box;
  int area_px = 0;
  std::vector<cv::Point> hull;           ///< Convex.
  std::vector<DisparitySample> samples;  ///< An even subset of its matched pixels.
};

struct PatchSettings {
  int opening_px;     ///< Side of the square that must fit into a patch everywhere.
  int gap_height_px;  ///< Largest height of a gap that is bridged between patches of the same
                      ///< columns.
  int gap_width_px;   ///< Largest width of a gap between patches of the same rows.
  int min_height_px;  ///< Patches that are shorter are dropped.
  /// A region is split where its disparities leave a gap of more than this.
  double disparity_step_px;
};

/// Finds the largest connected patches of the matched pixels (disparity > 0), largest first, by the
/// morphological opening and closing of FindConnectedComponents in Bradski and Kaehler 2008, ch. 9.
/// A departure: the closing is taller than wide, since block matching matches vertical edges, and
/// it is the pieces of one edge that have to be joined again.
std::vector<MatchedPatch> FindPatches(const cv::Mat1f& disparity, const PatchSettings& settings);

}  // namespace fenestra
