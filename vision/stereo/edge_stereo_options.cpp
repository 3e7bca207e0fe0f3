#include "vision/stereo/edge_stereo_options.h"

#include "core/input_error.h"

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
    made.Number("rectification_alpha", FENESTRA_FIELD(rectification_alpha), {0.0, 1.0},
                "0 shows only what both sensors saw, 1 all that either saw");
    made.Adopt<FrameSearchOptions>(FrameSearchParameters(), FENESTRA_FIELD(search));
    made.Number("black_dn", FENESTRA_FIELD(black_dn), {0.0, 255.0}, "grey value without light");
    made.Adopt<WindowPrior>(PriorParameters(SensorKind::kStereo), FENESTRA_FIELD(prior));
    return made;
  }();
  return table;
}

#undef FENESTRA_FIELD

void Validate(const Options& options) {
  std::vector<InputFault> faults;
  const auto demand = [&faults](bool holds, const std::string& message) {
    if (!holds) faults.push_back({"edge-stereo", 0, 0, message});
  };
  const Table& table = EdgeStereoParameters();
  for (const ParameterInfo& info : table.infos()) {
    const auto objection = info.Objection(table.Get(options, info.name));
    demand(!objection, objection.value_or(""));
  }
  for (const std::string& fault : FaultsOf(options.search)) demand(false, fault);
  for (const std::string& fault : FaultsOf(options.prior)) demand(false, fault);
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace fenestra
