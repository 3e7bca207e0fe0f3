#include "vision/rgbd/plane/plane_rgbd_options.h"

#include "core/io/faults.h"

namespace fenestra {
namespace {

using Options = PlaneRgbdOptions;
using Table = ParameterTable<Options>;

void AddDepth(Table& table) {
  table
      .Number("depth_noise_per_m", FENESTRA_FIELD(depth_noise_per_m), {1e-9, 1.0},
              "Typical standard deviation of a pixel's inverse depth (1/m).")
      .Number("depth_step_per_m", FENESTRA_FIELD(depth_step_per_m), {0.0, 1.0},
              "Quantum of the inverse depth (1/m); 0: none.")
      .Number("depth_window_px", FENESTRA_FIELD(depth_window_px), {1.0, 100.0},
              "Block with which a depth pixel was matched, in pixels of a 640-wide image.")
      .Number("depth_to_m", FENESTRA_FIELD(depth_to_m), {0.0, 1000.0},
              "Largest depth that the sensor reports; 0: no limit.")
      .Number("setback_m", FENESTRA_FIELD(setback_m), {-10.0, 10.0},
              "Distance of the frame's front behind the surrounding wall.")
      .Number("setback_sigma_m", FENESTRA_FIELD(setback_sigma_m), {0.0, 10.0},
              "Standard deviation of setback_m.");
}

}  // namespace

const Table& PlaneRgbdParameters() {
  static const Table table = [] {
    Table made;
    made.Adopt<FrameSearchOptions>(FrameSearchParameters(), FENESTRA_FIELD(search));
    AddDepth(made);
    made.Adopt<WindowPrior>(PriorParameters(SensorKind::kRgbd), FENESTRA_FIELD(prior));
    return made;
  }();
  return table;
}

void Validate(const Options& options) {
  Faults faults("plane-rgbd");
  faults.Add(PlaneRgbdParameters().Objections(options));
  faults.Add(FaultsOf(options.search));
  faults.Add(FaultsOf(options.prior));
  faults.ThrowIfAny();
}

}  // namespace fenestra
