#pragma once

#include <opencv2/core.hpp>
#include <variant>
#include <vector>

#include "core/detection.h"
#include "vision/frame/quadrilateral.h"
#include "vision/stereo/matched_patch.h"
#include "vision/window_prior.h"

namespace fenestra {

/// What a window frame must be like; all from the disparity image alone, and what may be
/// known beforehand.
struct FrameCriteria {
  int window_px;              ///< SAD window, by which matched regions are fattened.
  double plane_tolerance_px;  ///< A pixel further from a plane is not on it.
  double min_inlier_share;    ///< Of a hypothesis' matched pixels, on its plane.
  double min_row_overlap;     ///< Rows that both bands cover / rows that either covers.
  double min_side_support;    ///< Share of the left and of the right side that is matched.
  double max_opening_rows;    ///< Share of the opening's rows with matches in the frame's plane.
  double nearest_m;
  double farthest_m;
  double min_side_m;
  double max_side_m;
  double max_side_ratio;  ///< Longer over shorter side.
  double max_skew_rad;    ///< Departure of a corner from a right angle.
  double max_taper;       ///< Relative difference of opposite sides.
  WindowPrior prior{};    ///< What is known of the window.
};

/// A closed contour in one plane that may be a frame.
struct FrameHypothesis {
  std::vector<cv::Point> hull;  ///< Convex; the closed contour, fattened by the SAD window.
  Quadrilateral corners_px;     ///< Of the hull.
  DisparityPlane plane;
  std::vector<const MatchedPatch*> patches;  ///< One or two, that it was made of.
  /// How much speaks for it, 0 to 1: share of its matches on the plane, times that of its less
  /// matched side, times that of the opening's rows that are free.
  double score = 0.0;
};

/// "implausible_shape", or an objection of the prior, with what was wrong; or nothing.
std::optional<Miss> ObjectionToShape(const WindowEstimate& estimate_F,
                                     const FrameCriteria& criteria);

/// The frames among the patches.
///
/// On a plain wall only the vertical sides of a frame have a disparity; the horizontal ones slide
/// along themselves (aperture problem). So what closes the contour is the convex hull of *two*
/// patches, with the plane fitted to both in between; or of one, where the whole ring is matched
/// (a frame that is rolled, or textured). Bradski and Kaehler 2008, ch. 9, replace a component by
/// its convex hull; that two of them are taken together is this program's choice.
///
/// A hypothesis is kept if its patches cover the same rows, its plane holds them, its two vertical
/// sides are matched along their length, its opening is not filled in the frame's own plane
/// (whatever can be flown through has no surface there), and its shape is plausible. Of those whose
/// centre lies within another one only the larger is kept, as a frame's outer edge encloses its
/// inner one; at most `most` of the others, the largest in the image, ordered by score. They refer
/// to `patches`.
///
/// Miss: "no_component_pair" or "implausible_shape", by how far the best hypothesis came.
std::variant<std::vector<FrameHypothesis>, Miss> FindFrames(
    const std::vector<MatchedPatch>& patches, const cv::Mat1f& disparity,
    const RectifiedCamera& camera, const FrameCriteria& criteria, size_t most);

}  // namespace fenestra
