#include "vision/stereo/edge_stereo_options.h"

#include "core/demands.h"

namespace fenestra {
namespace {

using Options = EdgeStereoOptions;
using Table = ParameterTable<Options>;

#define FENESTRA_FIELD(field) \
  [](Options & o) -> auto& {  \
    return o.field;           \
  }

}  // namespace

const Table& EdgeStereoParameters() {
  static const Table table = [] {
    Table made;
    made.Number(
        "rectification_alpha", FENESTRA_FIELD(rectification_alpha), {0.0, 1.0},
        "Zoom of rectification: 0 keeps only what both sensors saw, 1 all that either saw.");
    made.Adopt<FrameSearchOptions>(FrameSearchParameters(), FENESTRA_FIELD(search));
    made.Number("black_dn", FENESTRA_FIELD(black_dn), {0.0, 255.0}, "Grey value without light.");
    made.Adopt<WindowPrior>(PriorParameters(SensorKind::kStereo), FENESTRA_FIELD(prior));
    return made;
  }();
  return table;
}

#undef FENESTRA_FIELD

void Validate(const Options& options) {
  Demands demand("edge-stereo");
  demand.Add(EdgeStereoParameters().Objections(options));
  demand.Add(FaultsOf(options.search));
  demand.Add(FaultsOf(options.prior));
  demand.ThrowUnlessMet();
}

}  // namespace fenestra
