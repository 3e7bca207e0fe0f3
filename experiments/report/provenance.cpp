#include "experiments/report/provenance.h"

#include <fmt/format.h>

#include "core/detection/window_prior.h"

namespace fenestra {

std::string PriorText(const DetectorChoice& detector) {
  const DetectorInfo* info = FindDetector(detector.name);
  const OptionValues defaults = info ? DefaultChoice(*info).options : OptionValues{};
  FactorValues told;
  for (const auto& [name, value] : detector.options) {
    if (!IsPriorOption(name)) continue;
    const auto by_default = defaults.find(name);
    if (by_default != defaults.end() && by_default->second == value) continue;
    told.emplace_back(name, value);
  }
  return LevelsText(told);
}

std::vector<std::pair<std::string, std::string>> PriorEntries(const Study& study) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const StudyPart& part : study.parts) {
    for (const DetectorChoice& detector : part.detectors) {
      const std::string text = PriorText(detector);
      if (text.empty()) continue;
      entries.emplace_back(fmt::format("Prior of {} in {}", detector.label, part.name), text);
    }
  }
  if (entries.empty()) entries.emplace_back("Prior", "none");
  return entries;
}

}  // namespace fenestra
