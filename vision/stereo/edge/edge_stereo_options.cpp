#include "vision/stereo/edge/edge_stereo_options.h"

#include "core/io/faults.h"

namespace fenestra {
namespace {

using Options = EdgeStereoOptions;
using Table = ParameterTable<Options>;

}  // namespace

const Table& EdgeStereoParameters() {
  static const Table table = [] {
    Table made;
    made.Number("rectification_alpha", FENESTRA_FIELD(rectification_alpha), {0.0, 1.0},
                "0 shows only what both sensors saw, 1 all that either saw");
    made.Adopt<FrameSearchOptions>(FrameSearchParameters(), FENESTRA_FIELD(search));
    made.Number("black_dn", FENESTRA_FIELD(black_dn), {0.0, 255.0}, "grey value without light");
    made.Adopt<WindowPrior>(PriorParameters(SensorKind::kStereo), FENESTRA_FIELD(prior));
    return made;
  }();
  return table;
}

void Validate(const Options& options) {
  Faults faults("edge-stereo");
  faults.Add(EdgeStereoParameters().Objections(options));
  faults.Add(FaultsOf(options.search));
  faults.Add(FaultsOf(options.prior));
  faults.ThrowIfAny();
}

}  // namespace fenestra
