#include "experiments/sampling/causes.h"

#include <algorithm>

#include "core/system/check.h"

namespace fenestra {
namespace {

bool Uses(const StudyPart& part, SensorKind sensor) {
  return std::find(part.sensors.begin(), part.sensors.end(), sensor) != part.sensors.end();
}

bool IsStream(const std::string& source) {
  return source == kShotSource || source == kRigSource || source == kCalibrationSource;
}

const char* CauseOf(FactorGroup group) {
  switch (group) {
    case FactorGroup::kViewpoint:
      return "pose";
    case FactorGroup::kLight:
      return "light";
    case FactorGroup::kScene:
    case FactorGroup::kFacade:
      return "scene";
    case FactorGroup::kStereo:
    case FactorGroup::kRgbd:
      return "sensor";
  }
  FENESTRA_CHECK(false, "factor group out of range");
}

bool ActsIn(const std::string& source, const Cell& cell) {
  if (source == kShotSource) return true;
  if (!IsStream(source)) return Concerns(GroupOf(source), cell.sensor);
  // What is told of an RGB-D sensor is its design.
  if (cell.sensor == SensorKind::kRgbd && source == kCalibrationSource) return false;
  return EachTrialHasItsOwnSensor(cell.settings, cell.sensor);
}

}  // namespace

std::vector<Cause> CausesOf(const Study& study, const Cell& cell) {
  std::vector<Cause> causes;
  for (Cause cause : study.parts[cell.part_index].design.causes) {
    std::erase_if(cause.sources, [&cell](const auto& source) { return !ActsIn(source, cell); });
    if (!cause.sources.empty()) causes.push_back(std::move(cause));
  }
  return causes;
}

std::vector<std::string> SourcesOf(const StudyPart& part) {
  std::vector<std::string> sources{kShotSource, kRigSource};
  if (Uses(part, SensorKind::kStereo)) sources.emplace_back(kCalibrationSource);
  for (const Factor& factor : part.factors) {
    if (std::holds_alternative<Distribution>(factor.setting)) sources.push_back(factor.name);
  }
  return sources;
}

std::vector<Cause> DefaultCauses(const StudyPart& part) {
  std::vector<Cause> causes{{"noise", {}}, {"calibration", {}}, {"pose", {}},
                            {"light", {}}, {"scene", {}},       {"sensor", {}}};
  for (const std::string& source : SourcesOf(part)) {
    const std::string name = source == kShotSource ? "noise"
                             : IsStream(source)    ? "calibration"
                                                   : CauseOf(GroupOf(source));
    const auto cause =
        std::find_if(causes.begin(), causes.end(), [&](const Cause& c) { return c.name == name; });
    cause->sources.push_back(source);
  }
  std::erase_if(causes, [](const Cause& cause) { return cause.sources.empty(); });
  return causes;
}

PickFreezePlace PickFreezePlace::Of(int trial_index, size_t causes) {
  const int columns = PickFreezeColumns(causes);
  return {.row = trial_index / columns, .column = trial_index % columns};
}

}  // namespace fenestra
