#pragma once

#include <opencv2/core.hpp>
#include <variant>
#include <vector>

#include "core/detection/detection.h"
#include "core/detection/window_prior.h"
#include "vision/frame/detection/quadrilateral.h"
#include "vision/stereo/paper/matched_patch.h"

namespace fenestra {

/// Requirements on a window frame that can be checked in the disparity image alone, and prior
/// knowledge of the window.
struct FrameCriteria {
  int window_px;              ///< Side of the SAD block, by which matched regions are fattened.
  double plane_tolerance_px;  ///< A pixel farther from a plane than this is not on it.
  double min_inlier_share;    ///< Least share of a hypothesis' matched pixels on its plane.
  double
      min_row_overlap;  ///< Least ratio of rows that both bands cover to rows that either covers.
  double min_side_support;  ///< Least matched share of the left and of the right side.
  double
      max_opening_rows;  ///< Largest share of the opening's rows with matches in the frame's plane.
  double nearest_m;
  double farthest_m;
  double min_side_m;
  double max_side_m;
  double max_side_ratio;  ///< Longer side over shorter side.
  double max_skew_rad;    ///< Departure of a corner from a right angle.
  double max_taper;       ///< Relative difference of opposite sides.
  WindowPrior prior{};    ///< What is known of the window.
};

/// A closed contour in one plane that may be a frame.
struct FrameHypothesis {
  std::vector<cv::Point> hull;  ///< Convex; the closed contour, fattened by the SAD block.
  Quadrilateral corners_px;     ///< Corners of the hull.
  DisparityPlane plane;
  std::vector<const MatchedPatch*> patches;  ///< The one or two patches that it consists of.
  /// Score, 0 to 1: the product of the share of its matches on the plane, the matched share of its
  /// less matched side, and the free share of the opening's rows.
  double score = 0.0;
};

/// Returns "implausible_shape" or an objection of the prior, with the reason, or nullopt if the
/// shape is plausible.
std::optional<Miss> ObjectionToShape(const WindowEstimate& estimate_F,
                                     const FrameCriteria& criteria);

/// Finds the frames among the patches.
///
/// On a plain wall only the vertical sides of a frame have a disparity; that of the horizontal ones
/// is ambiguous (aperture problem). The contour is therefore closed by the convex hull of *two*
/// patches, with a plane fitted to both, or of one patch if the whole ring is matched (for a frame
/// that is rolled or textured). Bradski and Kaehler 2008, ch. 9, replace a component by its convex
/// hull; combining two of them is a departure.
///
/// A hypothesis is kept if its patches cover the same rows, its plane holds them, its two vertical
/// sides are matched along their length, its opening is not filled in the frame's own plane
/// (whatever can be flown through has no surface there), and its shape is plausible. If the centre
/// of one lies within another, only the larger is kept, since a frame's outer edge encloses its
/// inner one. Of the remaining ones the `most` largest in the image are returned, ordered by score.
/// They refer to `patches`.
///
/// Miss: "no_component_pair" or "implausible_shape", depending on how far the best hypothesis got.
std::variant<std::vector<FrameHypothesis>, Miss> FindFrames(
    const std::vector<MatchedPatch>& patches, const cv::Mat1f& disparity,
    const RectifiedCamera& camera, const FrameCriteria& criteria, size_t most);

}  // namespace fenestra
