#include "vision/rgbd/plane_rgbd_options.h"

#include <numbers>

#include "core/input_error.h"

namespace fenestra {
namespace {

using Options = PlaneRgbdOptions;
using Table = ParameterTable<Options>;

constexpr double kDegree = std::numbers::pi / 180.0;

#define FENESTRA_FIELD(field) \
  [](Options & o) -> auto& {  \
    return o.field;           \
  }

void AddShape(Table& table) {
  table.Number("nearest_m", FENESTRA_FIELD(nearest_m), {0.1, 1000.0}, "smallest depth of a window")
      .Number("farthest_m", FENESTRA_FIELD(farthest_m), {0.1, 1000.0}, "largest depth of a window")
      .Number("min_side_m", FENESTRA_FIELD(min_side_m), {0.01, 1000.0}, "smallest window side")
      .Number("max_side_m", FENESTRA_FIELD(max_side_m), {0.01, 1000.0}, "largest window side")
      .Number("max_side_ratio", FENESTRA_FIELD(max_side_ratio), {1.0, 100.0},
              "longest side over shortest side")
      .Number("max_skew_deg", FENESTRA_FIELD(max_skew_rad), {0.0, 90.0, kDegree},
              "departure of a corner from a right angle, before the fit")
      .Number("max_taper", FENESTRA_FIELD(max_taper), {0.0, 2.0},
              "relative difference of opposite sides, before the fit");
}

void AddLook(Table& table) {
  table
      .Number("min_contrast_dn", FENESTRA_FIELD(min_contrast_dn), {1.0, 255.0},
              "weakest step of an edge; 200: the brightest part of the image")
      .Number("vignetting_power", FENESTRA_FIELD(vignetting_power), {0.0, 10.0},
              "light falls off as this power of the cosine to the optical axis; 0: corrected")
      .Number("min_segment_px", FENESTRA_FIELD(min_segment_px), {4.0, 1000.0},
              "shortest piece of a straight edge")
      .Integer("most_segments", FENESTRA_FIELD(most_segments), {4.0, 200.0},
               "straight edges that are kept, for each side")
      .Integer("most_candidates", FENESTRA_FIELD(most_candidates), {1.0, 100.0},
               "rough rectangles that are measured")
      .Integer("most_windows", FENESTRA_FIELD(most_windows), {1.0, 100.0},
               "windows that are looked for, the best first")
      .Number("min_side_support", FENESTRA_FIELD(min_side_support), {0.0, 1.0},
              "share of each side that must be seen")
      .Number("min_darkness", FENESTRA_FIELD(min_darkness), {0.0, 1.0},
              "how much darker the frame must be than what surrounds it; 1: four times")
      .Number("min_border_m", FENESTRA_FIELD(min_border_m), {0.001, 10.0},
              "narrowest frame whose inner edge is used")
      .Number("max_border_share", FENESTRA_FIELD(max_border_share), {0.01, 0.49},
              "widest frame, as a share of the shorter side");
}

void AddDepth(Table& table) {
  table
      .Number("depth_noise_per_m", FENESTRA_FIELD(depth_noise_per_m), {1e-9, 1.0},
              "usual standard deviation of a pixel's inverse depth (1/m)")
      .Number("depth_step_per_m", FENESTRA_FIELD(depth_step_per_m), {0.0, 1.0},
              "quantum of the inverse depth (1/m); 0: none")
      .Number("depth_window_px", FENESTRA_FIELD(depth_window_px), {1.0, 100.0},
              "window in which a depth pixel was matched, in pixels of a 640-wide image")
      .Number("depth_to_m", FENESTRA_FIELD(depth_to_m), {0.0, 1000.0},
              "largest depth that the sensor gives; 0: no limit")
      .Number("setback_m", FENESTRA_FIELD(setback_m), {-10.0, 10.0},
              "frame's front behind the wall around it")
      .Number("setback_sigma_m", FENESTRA_FIELD(setback_sigma_m), {0.0, 10.0},
              "standard deviation of that knowledge");
}

}  // namespace

const Table& PlaneRgbdParameters() {
  static const Table table = [] {
    Table made;
    AddShape(made);
    AddLook(made);
    AddDepth(made);
    made.Adopt<WindowPrior>(PriorParameters(SensorKind::kRgbd), FENESTRA_FIELD(prior));
    return made;
  }();
  return table;
}

#undef FENESTRA_FIELD

void Validate(const Options& options) {
  std::vector<InputFault> faults;
  const auto demand = [&faults](bool holds, const std::string& message) {
    if (!holds) faults.push_back({"plane-rgbd", 0, 0, message});
  };
  const Table& table = PlaneRgbdParameters();
  for (const ParameterInfo& info : table.infos()) {
    const auto objection = info.Objection(table.Get(options, info.name));
    demand(!objection, objection.value_or(""));
  }
  demand(options.nearest_m < options.farthest_m, "nearest_m must be less than farthest_m");
  demand(options.min_side_m < options.max_side_m, "min_side_m must be less than max_side_m");
  for (const std::string& fault : FaultsOf(options.prior)) demand(false, fault);
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace fenestra
