#pragma once

#include "core/parameter_table.h"
#include "vision/window_prior.h"

namespace fenestra {

/// What the paper leaves open in its stereo method, each with the reason for its default.
struct PaperStereoOptions {
  // Rectification.
  /// 1 keeps all that the sensors saw, at the price of a slightly smaller image for a lens with
  /// barrel distortion; 0 would cut off near windows.
  double rectification_alpha = 1.0;

  // Block matching ("small SAD windows").
  /// A little nearer than the distance at which a 1 m window fills the image of a 4 mm lens.
  double nearest_m = 1.2;
  /// Where a 1 m frame is 44 px wide and a tenth of a pixel of disparity is 10 cm of depth.
  double farthest_m = 15.0;
  /// Within the 5 to 21 px that Bradski and Kaehler name; wide enough for both edges of a 0.1 m
  /// border from 6 m on, small enough to leave the opening of a 1 m frame at 10 m free.
  int sad_window_px = 15;
  /// With 0 about a fifth of the matches on a plain wall are wrong by more than a pixel; with 10
  /// few are.
  int uniqueness_percent = 10;
  /// Sum over the window of the pre-filtered image's departure from flat. An edge of 8 DN and more
  /// has 465 for each column of the window that it fills; the 8-bit steps of a smoothly shaded wall
  /// have up to 400 and would match anywhere; a camera's noise has more, but is not unique.
  int texture_threshold = 500;
  /// An accidental match of one feature is at most as large as the SAD window.
  int speckle_area_px = 200;
  double speckle_step_px = 1.0;
  /// Off, as the paper names no such check; the uniqueness test is meant for the same faults.
  bool left_right_check = false;
  /// Search again near what was found if that is no frame, see guided_matching.h. Without it a
  /// frame's right side is lost where its double is in range: 1 m frames beyond 4.6 m.
  bool guided_search = true;

  // Gap closing.
  /// All that is matched is as wide as the SAD window or wider, since every pixel whose window
  /// touches an edge is matched. Half of it takes stragglers off the contour and nothing else.
  int opening_px = 7;
  /// Joins the pieces of a vertical edge; less than the opening of a 1 m frame at 10 m (39 px
  /// between fattened horizontal sides).
  int gap_height_px = 25;
  /// Joins the two edges of one narrow border, but not the two sides of a far frame.
  int gap_width_px = 5;
  /// 1 m at 33 m: more than twice the farthest depth.
  int min_band_height_px = 20;
  /// Twelve steps of the matcher's 1/16 px: above its sub-pixel bias, below a wrong match.
  double plane_tolerance_px = 0.75;
  double min_inlier_share = 0.6;
  /// A side that is cut at one end by something in front of it still passes.
  double min_row_overlap = 0.7;
  /// Half: more than chance makes of two blobs, and less than noise leaves of a far frame's side.
  double min_side_support = 0.5;
  double max_opening_rows = 0.5;

  // Plausible windows: what a drone might fly through, and no prior of the window's size.
  double min_side_m = 0.3;
  double max_side_m = 3.0;
  double max_side_ratio = 2.0;
  /// 15°: corners are known to some pixels only, which is 5° for a far frame.
  double max_skew_rad = 0.2617993877991494;
  double max_taper = 0.25;

  // The estimate and its covariance.
  /// The paper has one window in view; the largest in the image come first, as many as this.
  int most_windows = 3;
  /// What a whole side's disparity is off by: a parabola through SAD sums errs with the phase of an
  /// upright edge against the pixels. From the depth errors without noise, 0.035 px of a window's
  /// disparity, times √2 for one of its two sides.
  double subpixel_bias_px = 0.05;
  /// Where a band begins: its first match is a pixel early or late. From the errors across the
  /// optical axis, 0.6 to 0.9 px of the centre, times √2.
  double contour_sigma_px = 1.1;

  /// Grey value without light, for a prior's grey ratio: 32 of 1023, the usual pedestal of a
  /// sensor's ADC, as 8 bits show it.
  double black_dn = 8.0;
  /// What is known beforehand; nothing by default, as in the paper.
  WindowPrior prior;

  // Contour.
  /// In the 8-bit depth image a frame stands at least 64 grey values, four times that in a Sobel
  /// filter's output, above nothing.
  double canny_low_dn = 60.0;
  double canny_high_dn = 120.0;
  /// A pixel is matched as soon as its SAD window touches an edge, so the matched region is the
  /// frame dilated by half a window; this takes it back. The paper does not; corners are then too
  /// far out by that much, the centroid is the same.
  bool undo_fattening = true;

  bool operator==(const PaperStereoOptions&) const = default;
};

/// Throws InputError with all faults: values out of their parameter's range, an even SAD window,
/// limits in the wrong order.
void Validate(const PaperStereoOptions& options);

const ParameterTable<PaperStereoOptions>& PaperStereoParameters();

}  // namespace fenestra
