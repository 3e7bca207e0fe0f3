#include "vision/frame/frame_search.h"

#include "core/geometry/pose.h"

namespace fenestra {
namespace {

using Options = FrameSearchOptions;
using Table = ParameterTable<Options>;

void AddShape(Table& table) {
  table
      .Number("nearest_m", FENESTRA_FIELD(limits.nearest_m), {0.1, 1000.0},
              "Smallest depth of a window.")
      .Number("farthest_m", FENESTRA_FIELD(limits.farthest_m), {0.1, 1000.0},
              "Largest depth of a window.")
      .Number("min_side_m", FENESTRA_FIELD(limits.min_side_m), {0.01, 1000.0},
              "Smallest window side.")
      .Number("max_side_m", FENESTRA_FIELD(limits.max_side_m), {0.01, 1000.0},
              "Largest window side.")
      .Number("max_side_ratio", FENESTRA_FIELD(limits.max_side_ratio), {1.0, 100.0},
              "Largest ratio of the longest side to the shortest.")
      .Number("max_skew_deg", FENESTRA_FIELD(limits.max_skew_rad), {0.0, 90.0, kDegree},
              "Largest departure of a corner from a right angle, before the fit.")
      .Number("max_taper", FENESTRA_FIELD(limits.max_taper), {0.0, 2.0},
              "Largest relative difference of opposite sides, before the fit.");
}

void AddLook(Table& table) {
  table
      .Number("min_contrast_dn", FENESTRA_FIELD(min_contrast_dn), {1.0, 255.0},
              "Weakest step of an edge.")
      .Number("vignetting_power", FENESTRA_FIELD(vignetting_power), {0.0, 10.0},
              "Vignetting: light falls off as this power of the cosine to the optical axis; 0: "
              "corrected.")
      .Number("min_segment_px", FENESTRA_FIELD(min_segment_px), {4.0, 1000.0},
              "Shortest piece of a straight edge.")
      .Integer("most_segments", FENESTRA_FIELD(most_segments), {4.0, 200.0},
               "Most straight edges that are kept for each side.")
      .Integer("most_candidates", FENESTRA_FIELD(most_candidates), {1.0, 100.0},
               "Most rough rectangles that are measured.")
      .Integer("most_windows", FENESTRA_FIELD(most_windows), {1.0, 100.0},
               "Most windows that are reported, the best first.")
      .Number("min_side_support", FENESTRA_FIELD(min_side_support), {0.0, 1.0},
              "Least share of each side that must be seen.")
      .Number("min_darkness", FENESTRA_FIELD(min_darkness), {0.0, 1.0},
              "How much darker the frame must be than its surroundings; 1: four times.")
      .Number("min_border_m", FENESTRA_FIELD(min_border_m), {0.001, 10.0},
              "Narrowest frame whose inner edge is used.")
      .Number("max_border_share", FENESTRA_FIELD(max_border_share), {0.01, 0.49},
              "Widest frame, as a share of the shorter side.");
}

}  // namespace

const Table& FrameSearchParameters() {
  static const Table table = [] {
    Table made;
    AddShape(made);
    AddLook(made);
    return made;
  }();
  return table;
}

std::vector<std::string> FaultsOf(const Options& options) {
  std::vector<std::string> faults;
  const FrameLimits& limits = options.limits;
  if (!(limits.nearest_m < limits.farthest_m)) {
    faults.push_back("nearest_m must be less than farthest_m");
  }
  if (!(limits.min_side_m < limits.max_side_m)) {
    faults.push_back("min_side_m must be less than max_side_m");
  }
  return faults;
}

}  // namespace fenestra
