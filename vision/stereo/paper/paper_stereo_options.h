#pragma once

#include "core/detection/window_prior.h"
#include "core/io/parameter_table.h"

namespace fenestra {

/// Options of the paper's stereo method, each with the reason for its default.
struct PaperStereoOptions {
  // Rectification.
  /// 1 keeps all that the sensors saw, at the price of a slightly smaller scale for a lens with
  /// barrel distortion; 0 would cut off near windows.
  double rectification_alpha = 1.0;

  // Block matching (the paper's "small SAD windows").
  /// Slightly less than the distance at which a 1 m window fills the image of a 4 mm lens.
  double nearest_m = 1.2;
  /// At this distance a 1 m frame is 44 px wide, and a tenth of a pixel of disparity is 10 cm of
  /// depth.
  double farthest_m = 15.0;
  /// Within the 5 to 21 px that Bradski and Kaehler recommend; wide enough for both edges of a 0.1
  /// m border from 6 m on, and small enough to leave the opening of a 1 m frame at 10 m free.
  int sad_window_px = 15;
  /// With 0 about a fifth of the matches on a plain wall are wrong by more than a pixel; with 10
  /// few are.
  int uniqueness_percent = 10;
  /// Least sum over the block of the pre-filtered image's departure from flat. An edge of at least
  /// 8 DN has 465 for each column of the block that it fills. The 8-bit steps of a smoothly shaded
  /// wall have up to 400 and would match anywhere; a camera's noise has more, but fails the
  /// uniqueness test.
  int texture_threshold = 500;
  /// An accidental match of one feature is at most as large as the SAD block.
  int speckle_area_px = 200;
  double speckle_step_px = 1.0;
  /// Off by default, since the paper names no such check and the uniqueness test addresses the same
  /// faults.
  bool left_right_check = false;
  /// Searches again near the first result if that contains no frame, see MatchAgainNearPatches.
  /// Without it a frame's right side is lost where its double is in range, i.e. for 1 m frames
  /// beyond 4.6 m.
  bool guided_search = true;

  // Gap closing.
  /// Half the SAD block. Matched regions are at least as wide as the block, since every pixel whose
  /// block touches an edge is matched, so an opening of half its size removes stragglers from the
  /// contour and nothing else.
  int opening_px = 7;
  /// Joins the pieces of a vertical edge; smaller than the opening of a 1 m frame at 10 m (39 px
  /// between the fattened horizontal sides).
  int gap_height_px = 25;
  /// Joins the two edges of one narrow border, but not the two sides of a far frame.
  int gap_width_px = 5;
  /// The height of 1 m at 33 m, more than twice the farthest depth.
  int min_band_height_px = 20;
  /// Twelve of the matcher's steps of 1/16 px: more than its sub-pixel bias, less than a wrong
  /// match.
  double plane_tolerance_px = 0.75;
  double min_inlier_share = 0.6;
  /// A side that an object in front of it cuts off at one end still passes.
  double min_row_overlap = 0.7;
  /// Half of a side is more than two patches cover by chance, and less than noise leaves of a far
  /// frame's side.
  double min_side_support = 0.5;
  double max_opening_rows = 0.5;

  // Plausible windows: openings that a drone might fly through, without a prior on the window's
  // size.
  double min_side_m = 0.3;
  double max_side_m = 3.0;
  double max_side_ratio = 2.0;
  /// 15°: corners are known only to some pixels, which corresponds to 5° for a far frame.
  double max_skew_rad = 0.2617993877991494;
  double max_taper = 0.25;

  // The estimate and its covariance.
  /// Largest number of windows, the largest in the image first. The paper has one window in view.
  int most_windows = 3;
  /// Standard deviation of the disparity error that a whole side shares: the error of a parabola
  /// through SAD sums depends on the phase of a vertical edge relative to the pixels. It follows
  /// from the depth errors without noise, which are 0.035 px of a window's disparity, times √2 for
  /// one of its two sides.
  double subpixel_bias_px = 0.05;
  /// Standard deviation of the place where a band begins, since its first match is a pixel early or
  /// late. It follows from the errors perpendicular to the optical axis, 0.6 to 0.9 px of the
  /// centre, times √2.
  double contour_sigma_px = 1.1;

  /// Grey value without light, for a prior's grey ratio: 32 of 1023, the usual pedestal of a
  /// sensor's ADC, in 8 bits.
  double black_dn = 8.0;
  /// Prior knowledge of the window; none by default, as in the paper.
  WindowPrior prior;

  // Contour.
  /// In the 8-bit depth image a frame is at least 64 grey values above pixels without depth, which
  /// is four times as much in the output of a Sobel filter.
  double canny_low_dn = 60.0;
  double canny_high_dn = 120.0;
  /// A pixel is matched as soon as its SAD block touches an edge, so the matched region is the
  /// frame dilated by half a block. This option undoes the dilation. The paper does not, which
  /// moves the corners outwards by that much but leaves the centroid unchanged.
  bool undo_fattening = true;

  bool operator==(const PaperStereoOptions&) const = default;
};

/// Throws InputError with all faults: values out of their parameter's range, an even SAD block
/// size, limits in the wrong order.
void Validate(const PaperStereoOptions& options);

const ParameterTable<PaperStereoOptions>& PaperStereoParameters();

}  // namespace fenestra
