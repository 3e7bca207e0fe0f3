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
               "a pixel is dark if R, G and B are all below this (Algorithm 1: 50)")
      .Choice("cloud", FENESTRA_FIELD(cloud), {"all", "largest_component", "each_component"},
              "which dark pixels make the cloud; the paper takes all")
      .Integer("min_cloud_points", FENESTRA_FIELD(min_cloud_points), {3, 1e9},
               "smallest cloud that is searched")
      .Switch("unseen_is_far", FENESTRA_FIELD(unseen_is_far),
              "take unseen pixels of the range image for free sight to infinity")
      .Number("support_fraction", FENESTRA_FIELD(support_fraction), {0.01, 2.0},
              "NARF support size over the size of the cloud")
      .Number("support_size_m", FENESTRA_FIELD(support_size_m), {0.0, 5.0},
              "NARF support size; 0 takes it from support_fraction")
      .Number("max_support_px", FENESTRA_FIELD(max_support_px), {3.0, 1e4},
              "upper limit of support_fraction's support size in pixels of the range image")
      .Integer("max_range_image_width_px", FENESTRA_FIELD(max_range_image_width_px), {16, 16384},
               "widest range image; finer depth images are thinned out")
      .Number("min_interest_value", FENESTRA_FIELD(min_interest_value), {0.0, 1.0},
              "smallest NARF interest of a key point")
      .Number("plane_tolerance_m", FENESTRA_FIELD(plane_tolerance_m), {0.0, 1.0},
              "distance from the frame's plane, fixed part")
      .Number("plane_tolerance_per_m", FENESTRA_FIELD(plane_tolerance_per_m), {0.0, 1.0},
              "distance from the frame's plane, part per square of the depth (m/m²)")
      .Number("min_area_fraction", FENESTRA_FIELD(min_area_fraction), {0.0, 1.0},
              "smallest area of the four points over that of the cloud's hull")
      .Number("min_side_ratio", FENESTRA_FIELD(min_side_ratio), {0.0, 1.0},
              "smallest ratio of the shortest to the longest side")
      .Number(
          "max_filled_share", FENESTRA_FIELD(max_filled_share), {0.0, 1.0},
          "how much of the middle may be dark and on the plane; 1: not looked at, as in the paper")
      .Number(
          "min_seen_share", FENESTRA_FIELD(min_seen_share), {0.0, 1.0},
          "how much of each side must be dark and on the plane; 0: not looked at, as in the paper")
      .Number("key_point_sigma_share", FENESTRA_FIELD(key_point_sigma_share), {0.0, 2.0},
              "standard deviation of a vertex over NARF's support size, for the covariance")
      .Number("key_point_sigma_weight", FENESTRA_FIELD(key_point_sigma_weight), {0.0, 1000.0},
              "weight of that against the vertices' own residuals")
      .Number("depth_step_per_m", FENESTRA_FIELD(depth_step_per_m), {0.0, 1.0},
              "step of the depth per square of the depth (m/m²), for the covariance")
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
