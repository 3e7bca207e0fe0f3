#include "experiments/study_file/part_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiments/study_file/detector_reader.h"
#include "experiments/study_file/factor_reader.h"
#include "experiments/study_file/study_check.h"

namespace fenestra {
namespace {

constexpr const char* kOnlyPart = "main";

std::string ReadPartName(YamlReader& reader, const YAML::Node& part) {
  if (part["name"].IsDefined()) return ReadName(reader, part["name"], "a part's name").value_or("");
  reader.AddFault(part, "a part needs a name");
  return "";
}

void CheckRules(YamlReader& reader, const PartDraft& draft, const StudyPart& part) {
  for (const std::string& objection : RuleObjections(part)) {
    const bool own = draft.own.until || draft.own.envelope;
    reader.AddFault(own ? draft.own.node : reader.root(),
                    fmt::format("part '{}': {}", part.name, objection));
  }
}

std::vector<DetectorChoice> ResolveDetectors(YamlReader& reader, const PartDraft& draft,
                                             const std::vector<SensorKind>& sensors,
                                             std::span<const DetectorInfo> known) {
  const auto used = [&sensors](SensorKind sensor) {
    return std::find(sensors.begin(), sensors.end(), sensor) != sensors.end();
  };
  std::vector<DetectorChoice> detectors;
  if (draft.own.detectors) {
    for (const GivenDetector& given : *draft.own.detectors) {
      detectors.push_back(given.choice);
      if (used(given.choice.sensor) || !draft.sound()) continue;
      reader.AddFault(given.node,
                      fmt::format("{} works on {}, which part '{}' does not use", given.choice.name,
                                  ToString(given.choice.sensor), draft.name));
    }
  } else if (draft.common.detectors) {
    for (const GivenDetector& given : *draft.common.detectors) {
      if (used(given.choice.sensor)) detectors.push_back(given.choice);
    }
  } else {
    for (const DetectorInfo& info : known) {
      if (used(info.sensor)) detectors.push_back(DefaultChoice(info));
    }
  }
  for (const SensorKind sensor : sensors) {
    const bool served = std::any_of(detectors.begin(), detectors.end(),
                                    [sensor](const auto& d) { return d.sensor == sensor; });
    if (served || !draft.sound()) continue;
    reader.AddFault(draft.own.node, fmt::format("part '{}' has no detector for its sensor {}",
                                                draft.name, ToString(sensor)));
  }
  return detectors;
}

// Given factors first, then the defaults of all others; only those that can have an effect.
std::vector<Factor> ResolveFactors(const PartDraft& draft, StudyPart part) {
  std::set<std::string> placed;
  const auto place = [&](const GivenFactor& given) {
    const std::string& name = given.factor.name;
    if (placed.insert(name).second) part.factors.push_back(draft.FindFactor(name)->factor);
  };
  for (const GivenFactor& given : draft.common.factors) place(given);
  for (const GivenFactor& given : draft.own.factors) place(given);
  for (const ParameterInfo& info : Factors().infos()) {
    if (placed.contains(info.name)) continue;
    part.factors.push_back({info.name, Levels{WrittenDefault(info)}});
  }
  std::vector<Factor> effective;
  std::copy_if(part.factors.begin(), part.factors.end(), std::back_inserter(effective),
               [&part](const Factor& f) { return WhyWithoutEffect(f.name, part).empty(); });
  return effective;
}

}  // namespace

const std::vector<std::string>& PartKeys() {
  static const std::vector<std::string> keys = WithBlockKeys({"name"});
  return keys;
}

std::vector<PartDraft> ReadParts(YamlReader& reader, std::span<const DetectorInfo> known) {
  const YAML::Node& root = reader.root();
  const StudyBlock common = ReadBlock(reader, root, known);
  const YAML::Node parts = root["parts"];
  StudyBlock nothing;
  nothing.node = root;
  if (!parts.IsDefined()) return {{kOnlyPart, nothing, common}};
  if (!parts.IsSequence() || parts.size() == 0) {
    reader.AddFault(parts, fmt::format("parts must be a list of at least one part, not {}",
                                       YamlReader::Describe(parts)));
    return {};
  }
  std::vector<PartDraft> drafts;
  std::set<std::string> names;
  for (const YAML::Node& part : parts) {
    reader.CheckKeys(part, "a part", PartKeys());
    if (!part.IsMap()) continue;
    drafts.push_back({ReadPartName(reader, part), common, ReadBlock(reader, part, known)});
    if (!names.insert(drafts.back().name).second) {
      reader.AddFault(part["name"], fmt::format("two parts are called '{}'", drafts.back().name));
    }
  }
  return drafts;
}

StudyPart ResolvePart(YamlReader& reader, const PartDraft& draft,
                      std::span<const DetectorInfo> known) {
  StudyPart part{.name = draft.name,
                 .sensors = {SensorKind::kStereo, SensorKind::kRgbd},
                 .detectors = {},
                 .factors = {},
                 .repetitions = 1,
                 .design = {}};
  if (draft.common.sensors) part.sensors = *draft.common.sensors;
  if (draft.own.sensors) part.sensors = *draft.own.sensors;
  part.detectors = ResolveDetectors(reader, draft, part.sensors, known);
  part.factors = ResolveFactors(draft, part);
  const auto& design = draft.own.design ? draft.own.design : draft.common.design;
  if (design && draft.sound()) {
    part.design = ResolveDesign(reader, *design, part, draft.own.design.has_value());
  }
  const auto repetitions = draft.own.repetitions ? draft.own.repetitions : draft.common.repetitions;
  if (repetitions) {
    part.repetitions = *repetitions;
  } else if (draft.sound()) {
    reader.AddFault(draft.own.node, fmt::format("part '{}' needs repetitions: how many trials "
                                                "each cell gets",
                                                part.name));
  }
  part.until = draft.own.until ? draft.own.until : draft.common.until;
  part.envelope = draft.own.envelope ? draft.own.envelope : draft.common.envelope;
  if (draft.sound()) CheckRules(reader, draft, part);
  return part;
}

}  // namespace fenestra
