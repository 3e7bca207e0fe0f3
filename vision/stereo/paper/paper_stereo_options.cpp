#include "vision/stereo/paper/paper_stereo_options.h"

#include "core/geometry/pose.h"
#include "core/io/faults.h"

namespace fenestra {
namespace {

using Options = PaperStereoOptions;
using Table = ParameterTable<Options>;

void AddMatching(Table& table) {
  table
      .Number("rectification_alpha", FENESTRA_FIELD(rectification_alpha), {0.0, 1.0},
              "Zoom of rectification: 0 keeps only what both sensors saw, 1 all that either saw.")
      .Number("nearest_m", FENESTRA_FIELD(nearest_m), {0.1, 1000.0},
              "Smallest depth that is searched.")
      .Number("farthest_m", FENESTRA_FIELD(farthest_m), {0.1, 1000.0},
              "Largest depth that is searched.")
      .Integer("sad_window_px", FENESTRA_FIELD(sad_window_px), {5, 51},
               "Side of the SAD block; odd.")
      .Integer("uniqueness_percent", FENESTRA_FIELD(uniqueness_percent), {0, 100},
               "Margin by which the best match must beat all others.")
      .Integer("texture_threshold", FENESTRA_FIELD(texture_threshold), {0, 32000},
               "Least contrast, summed over the SAD block.")
      .Integer("speckle_area_px", FENESTRA_FIELD(speckle_area_px), {0, 100000},
               "Smallest patch of disparities that is kept; 0 keeps all.")
      .Number("speckle_step_px", FENESTRA_FIELD(speckle_step_px), {0.0625, 64.0},
              "Disparity step at which a patch ends.")
      .Switch("left_right_check", FENESTRA_FIELD(left_right_check),
              "Whether matches that are not mutual are dropped.")
      .Switch("guided_search", FENESTRA_FIELD(guided_search),
              "Whether to search again near the first matches if they contain no frame.");
}

void AddGapClosing(Table& table) {
  table
      .Integer("opening_px", FENESTRA_FIELD(opening_px), {1, 51},
               "Least thickness of matched regions; thinner ones are dropped.")
      .Integer("gap_height_px", FENESTRA_FIELD(gap_height_px), {1, 201},
               "Largest gap in a vertical edge that is closed.")
      .Integer("gap_width_px", FENESTRA_FIELD(gap_width_px), {1, 201},
               "Largest gap between adjacent edges that is closed.")
      .Integer("min_band_height_px", FENESTRA_FIELD(min_band_height_px), {3, 16384},
               "Least height of a patch that may be a side of a frame.")
      .Number("plane_tolerance_px", FENESTRA_FIELD(plane_tolerance_px), {0.0625, 16.0},
              "Largest departure of a match from the frame's plane, in disparity.")
      .Number("min_inlier_share", FENESTRA_FIELD(min_inlier_share), {0.0, 1.0},
              "Least share of a frame's matches on its plane.")
      .Number("min_row_overlap", FENESTRA_FIELD(min_row_overlap), {0.0, 1.0},
              "Least overlap of the rows of both sides.")
      .Number("min_side_support", FENESTRA_FIELD(min_side_support), {0.0, 1.0},
              "Least matched share of a vertical side.")
      .Number("max_opening_rows", FENESTRA_FIELD(max_opening_rows), {0.0, 1.0},
              "Largest share of the opening's rows with matches in the frame's plane.");
}

void AddShape(Table& table) {
  table.Number("min_side_m", FENESTRA_FIELD(min_side_m), {0.01, 1000.0}, "Smallest window side.")
      .Number("max_side_m", FENESTRA_FIELD(max_side_m), {0.01, 1000.0}, "Largest window side.")
      .Number("max_side_ratio", FENESTRA_FIELD(max_side_ratio), {1.0, 100.0},
              "Largest ratio of the longest side to the shortest.")
      .Number("max_skew_deg", FENESTRA_FIELD(max_skew_rad), {0.0, 90.0, kDegree},
              "Largest departure of a corner from a right angle.")
      .Number("max_taper", FENESTRA_FIELD(max_taper), {0.0, 2.0},
              "Largest relative difference of opposite sides.")
      .Number("canny_low_dn", FENESTRA_FIELD(canny_low_dn), {1.0, 1020.0},
              "Lower threshold of Canny's hysteresis: weakest edge that continues a stronger one.")
      .Number("canny_high_dn", FENESTRA_FIELD(canny_high_dn), {1.0, 1020.0},
              "Upper threshold of Canny's hysteresis: weakest edge that begins a contour.")
      .Integer("most_windows", FENESTRA_FIELD(most_windows), {1.0, 100.0},
               "Most windows that are reported, the best first.")
      .Number("subpixel_bias_px", FENESTRA_FIELD(subpixel_bias_px), {0.0, 2.0},
              "Standard deviation of the disparity of a whole side, for the covariance.")
      .Number("contour_sigma_px", FENESTRA_FIELD(contour_sigma_px), {0.0, 50.0},
              "Standard deviation of a contour's side, for the covariance.")
      .Number("black_dn", FENESTRA_FIELD(black_dn), {0.0, 255.0},
              "Grey value without light, for expected_grey_ratio.")
      .Switch("undo_fattening", FENESTRA_FIELD(undo_fattening),
              "Whether the contour is moved inwards by half a SAD block.");
}

}  // namespace

const Table& PaperStereoParameters() {
  static const Table table = [] {
    Table made;
    AddMatching(made);
    AddGapClosing(made);
    AddShape(made);
    made.Adopt<WindowPrior>(PriorParameters(SensorKind::kStereo), FENESTRA_FIELD(prior));
    return made;
  }();
  return table;
}

void Validate(const Options& options) {
  Faults faults("paper-stereo");
  faults.Add(PaperStereoParameters().Objections(options));
  faults.Require(options.sad_window_px % 2 == 1, "sad_window_px must be odd");
  faults.Require(options.nearest_m < options.farthest_m, "nearest_m must be less than farthest_m");
  faults.Require(options.min_side_m < options.max_side_m,
                 "min_side_m must be less than max_side_m");
  faults.Require(options.canny_low_dn <= options.canny_high_dn,
                 "canny_low_dn must not be more than canny_high_dn");
  faults.Add(FaultsOf(options.prior));
  faults.ThrowIfAny();
}

}  // namespace fenestra
