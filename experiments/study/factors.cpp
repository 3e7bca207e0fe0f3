#include "experiments/study/factors.h"

#include <fmt/format.h>

#include "core/system/check.h"
#include "experiments/study/factor_tables.h"

namespace fenestra {
namespace {

struct GroupedTable {
  FactorTable table;
  std::vector<FactorGroup> groups;  // One for each factor of the table.

  void Add(FactorGroup group, void (*add)(FactorTable&)) {
    add(table);
    groups.resize(table.infos().size(), group);
  }
};

const GroupedTable& AllFactors() {
  static const GroupedTable all = [] {
    GroupedTable factors;
    factors.Add(FactorGroup::kViewpoint, AddViewpointFactors);
    factors.Add(FactorGroup::kScene, AddSceneFactors);
    factors.Add(FactorGroup::kFacade, AddFacadeFactors);
    factors.Add(FactorGroup::kLight, AddLightFactors);
    factors.Add(FactorGroup::kStereo, AddStereoFactors);
    factors.Add(FactorGroup::kStereo, AddStereoImageFactors);
    factors.Add(FactorGroup::kRgbd, AddRgbdFactors);
    factors.Add(FactorGroup::kRgbd, AddRgbdColorFactors);
    return factors;
  }();
  return all;
}

}  // namespace

const ParameterTable<TrialSettings>& Factors() {
  return AllFactors().table;
}

FactorGroup GroupOf(const std::string& factor) {
  const ParameterInfo* info = Factors().Find(factor);
  FENESTRA_CHECK(info != nullptr, "unknown factor " + factor);
  return AllFactors().groups[static_cast<size_t>(info - Factors().infos().data())];
}

bool Concerns(FactorGroup group, SensorKind sensor) {
  if (group == FactorGroup::kStereo) return sensor == SensorKind::kStereo;
  if (group == FactorGroup::kRgbd) return sensor == SensorKind::kRgbd;
  return true;
}

std::string LevelsText(const FactorValues& levels, std::string_view is) {
  std::string text;
  for (const auto& [name, value] : levels) {
    text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", name, is, ToString(value));
  }
  return text;
}

std::string LevelText(const FactorValues& levels, const std::string& name) {
  for (const auto& [level, value] : levels) {
    if (level == name) return ToString(value);
  }
  return "";
}

}  // namespace fenestra
