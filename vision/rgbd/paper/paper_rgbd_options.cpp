#include "vision/rgbd/paper/paper_rgbd_options.h"

#include "core/io/faults.h"

namespace fenestra {
namespace {

using Options = PaperRgbdOptions;
using Table = ParameterTable<Options>;

Table MakeTable() {
  Table table;
  table
      .Integer("dark_below_dn", FENESTRA_FIELD(dark_below_dn), {1, 256},
               "A pixel is dark if R, G and B are all below this (Algorithm 1: 50).")
      .Choice("cloud", FENESTRA_FIELD(cloud), {"all", "largest_component", "each_component"},
              "Which dark pixels form the cloud; the paper uses all.")
      .Integer("min_cloud_points", FENESTRA_FIELD(min_cloud_points), {3, 1e9},
               "Smallest cloud that is searched.")
      .Switch("unseen_is_far", FENESTRA_FIELD(unseen_is_far),
              "Whether pixels without depth count as an unobstructed view to infinity.")
      .Number("support_fraction", FENESTRA_FIELD(support_fraction), {0.01, 2.0},
              "NARF's support size over the size of the cloud.")
      .Number("support_size_m", FENESTRA_FIELD(support_size_m), {0.0, 5.0},
              "NARF's support size; 0 derives it from support_fraction.")
      .Number(
          "max_support_px", FENESTRA_FIELD(max_support_px), {3.0, 1e4},
          "Upper limit of the support size from support_fraction, in pixels of the range image.")
      .Integer("max_range_image_width_px", FENESTRA_FIELD(max_range_image_width_px), {16, 16384},
               "Widest range image; finer depth images are thinned out.")
      .Number("min_interest_value", FENESTRA_FIELD(min_interest_value), {0.0, 1.0},
              "Smallest NARF interest of a key point.")
      .Number("plane_tolerance_m", FENESTRA_FIELD(plane_tolerance_m), {0.0, 1.0},
              "Largest distance from the frame's plane, fixed part.")
      .Number("plane_tolerance_per_m", FENESTRA_FIELD(plane_tolerance_per_m), {0.0, 1.0},
              "Largest distance from the frame's plane, part per square of the depth (m/m²).")
      .Number("min_area_fraction", FENESTRA_FIELD(min_area_fraction), {0.0, 1.0},
              "Smallest ratio of the area of the four points to that of the cloud's hull.")
      .Number("min_side_ratio", FENESTRA_FIELD(min_side_ratio), {0.0, 1.0},
              "Smallest ratio of the shortest to the longest side.")
      .Number("max_filled_share", FENESTRA_FIELD(max_filled_share), {0.0, 1.0},
              "Largest share of the middle that may be dark and on the plane; 1: no check, as in "
              "the paper.")
      .Number("min_seen_share", FENESTRA_FIELD(min_seen_share), {0.0, 1.0},
              "Least share of each side that must be dark and on the plane; 0: no check, as in the "
              "paper.")
      .Number("key_point_sigma_share", FENESTRA_FIELD(key_point_sigma_share), {0.0, 2.0},
              "Standard deviation of a vertex over NARF's support size, for the covariance.")
      .Number("key_point_sigma_weight", FENESTRA_FIELD(key_point_sigma_weight), {0.0, 1000.0},
              "Weight of key_point_sigma_share against the vertices' own residuals.")
      .Number("depth_step_per_m", FENESTRA_FIELD(depth_step_per_m), {0.0, 1.0},
              "Quantum of the depth per square of the depth (m/m²), for the covariance.")
      .Adopt<WindowPrior>(PriorParameters(SensorKind::kRgbd), FENESTRA_FIELD(prior));
  return table;
}

}  // namespace

const Table& PaperRgbdParameters() {
  static const Table table = MakeTable();
  return table;
}

void Validate(const PaperRgbdOptions& options) {
  Faults faults("paper-rgbd");
  faults.Add(PaperRgbdParameters().Objections(options));
  faults.Add(FaultsOf(options.prior));
  faults.ThrowIfAny();
}

}  // namespace fenestra
