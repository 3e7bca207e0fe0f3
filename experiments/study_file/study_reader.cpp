#include "experiments/study_file/study_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "experiments/study_file/factor_reader.h"
#include "experiments/study_file/name_reader.h"
#include "experiments/study_file/study_blocks.h"
#include "experiments/study_file/study_check.h"

namespace fenestra {
namespace {

constexpr const char* kOnlyPart = "main";

// A part while its study is read: what the study says for all parts, and what the part says.
struct PartDraft {
  std::string name;
  StudyBlock common;
  StudyBlock own;

  bool sound() const { return common.sound && own.sound; }
  /// Where the factor was given; nullptr for a default.
  const GivenFactor* FindFactor(const std::string& factor) const {
    const GivenFactor* given = own.FindFactor(factor);
    return given != nullptr ? given : common.FindFactor(factor);
  }
};

class StudyReader {
 public:
  StudyReader(YamlReader reader, std::span<const DetectorInfo> known)
      : reader_(std::move(reader)), known_(known) {}

  Study Read() {
    const YAML::Node& root = reader_.root();
    reader_.CheckKeys(root, "the study", StudyKeys());
    if (!root.IsMap()) reader_.ThrowIfFaulty();
    Study study = ReadHead(root);
    const std::vector<PartDraft> drafts = ReadDrafts(root);
    for (const PartDraft& draft : drafts) study.parts.push_back(Resolve(draft));
    CheckEffects(study, drafts);
    reader_.ThrowIfFaulty();
    CheckSize(study);
    reader_.ThrowIfFaulty();
    CheckContradictions(study, drafts);
    reader_.ThrowIfFaulty();
    return study;
  }

 private:
  Study ReadHead(const YAML::Node& root) {
    Study study{.name = {}, .description = {}, .seed = 1, .independent_cells = false, .parts = {}};
    if (root["name"].IsDefined()) {
      study.name = ReadName(reader_, root["name"], "name").value_or("");
    } else {
      reader_.AddFault(root, "the study needs a name");
    }
    if (root["description"].IsDefined()) {
      study.description = reader_.Text(root["description"], "description").value_or("");
    }
    if (root["seed"].IsDefined()) {
      const auto seed =
          reader_.Integer(root["seed"], "seed", 0, std::numeric_limits<int64_t>::max());
      study.seed = static_cast<uint64_t>(seed.value_or(0));
    }
    if (root["independent_cells"].IsDefined()) {
      study.independent_cells =
          reader_.Boolean(root["independent_cells"], "independent_cells").value_or(false);
    }
    return study;
  }

  std::vector<PartDraft> ReadDrafts(const YAML::Node& root) {
    const StudyBlock common = ReadBlock(reader_, root, known_);
    const YAML::Node parts = root["parts"];
    StudyBlock nothing;
    nothing.node = root;
    if (!parts.IsDefined()) return {{kOnlyPart, nothing, common}};
    if (!parts.IsSequence() || parts.size() == 0) {
      reader_.AddFault(parts, fmt::format("parts must be a list of at least one part, not {}",
                                          YamlReader::Describe(parts)));
      return {};
    }
    std::vector<PartDraft> drafts;
    std::set<std::string> names;
    for (const YAML::Node& part : parts) {
      reader_.CheckKeys(part, "a part", PartKeys());
      if (!part.IsMap()) continue;
      drafts.push_back({ReadPartName(part), common, ReadBlock(reader_, part, known_)});
      if (!names.insert(drafts.back().name).second) {
        reader_.AddFault(part["name"],
                         fmt::format("two parts are called '{}'", drafts.back().name));
      }
    }
    return drafts;
  }

  std::string ReadPartName(const YAML::Node& part) {
    if (part["name"].IsDefined())
      return ReadName(reader_, part["name"], "a part's name").value_or("");
    reader_.AddFault(part, "a part needs a name");
    return "";
  }

  StudyPart Resolve(const PartDraft& draft) {
    StudyPart part{.name = draft.name,
                   .sensors = {SensorKind::kStereo, SensorKind::kRgbd},
                   .detectors = {},
                   .factors = {},
                   .repetitions = 1,
                   .design = {}};
    if (draft.common.sensors) part.sensors = *draft.common.sensors;
    if (draft.own.sensors) part.sensors = *draft.own.sensors;
    part.detectors = ResolveDetectors(draft, part.sensors);
    part.factors = ResolveFactors(draft, part);
    const auto& design = draft.own.design ? draft.own.design : draft.common.design;
    if (design && draft.sound()) {
      part.design = ResolveDesign(reader_, *design, part, draft.own.design.has_value());
    }
    const auto repetitions =
        draft.own.repetitions ? draft.own.repetitions : draft.common.repetitions;
    if (repetitions) {
      part.repetitions = *repetitions;
    } else if (draft.sound()) {
      reader_.AddFault(draft.own.node, fmt::format("part '{}' needs repetitions: how many trials "
                                                   "each cell gets",
                                                   part.name));
    }
    part.until = draft.own.until ? draft.own.until : draft.common.until;
    part.envelope = draft.own.envelope ? draft.own.envelope : draft.common.envelope;
    if (draft.sound()) CheckRules(draft, part);
    return part;
  }

  void CheckRules(const PartDraft& draft, const StudyPart& part) {
    for (const std::string& objection : RuleObjections(part)) {
      const bool own = draft.own.until || draft.own.envelope;
      reader_.AddFault(own ? draft.own.node : reader_.root(),
                       fmt::format("part '{}': {}", part.name, objection));
    }
  }

  std::vector<DetectorChoice> ResolveDetectors(const PartDraft& draft,
                                               const std::vector<SensorKind>& sensors) {
    const auto used = [&sensors](SensorKind sensor) {
      return std::find(sensors.begin(), sensors.end(), sensor) != sensors.end();
    };
    std::vector<DetectorChoice> detectors;
    if (draft.own.detectors) {
      for (const GivenDetector& given : *draft.own.detectors) {
        detectors.push_back(given.choice);
        if (used(given.choice.sensor) || !draft.sound()) continue;
        reader_.AddFault(given.node,
                         fmt::format("{} works on {}, which part '{}' does not use",
                                     given.choice.name, ToString(given.choice.sensor), draft.name));
      }
    } else if (draft.common.detectors) {
      for (const GivenDetector& given : *draft.common.detectors) {
        if (used(given.choice.sensor)) detectors.push_back(given.choice);
      }
    } else {
      for (const DetectorInfo& info : known_) {
        if (used(info.sensor)) detectors.push_back(DefaultChoice(info));
      }
    }
    for (const SensorKind sensor : sensors) {
      const bool served = std::any_of(detectors.begin(), detectors.end(),
                                      [sensor](const auto& d) { return d.sensor == sensor; });
      if (served || !draft.sound()) continue;
      reader_.AddFault(draft.own.node, fmt::format("part '{}' has no detector for its sensor {}",
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

  // A part's own factors must have an effect there; the study's, in some part.
  void CheckEffects(const Study& study, const std::vector<PartDraft>& drafts) {
    const bool sound = std::all_of(drafts.begin(), drafts.end(),
                                   [](const PartDraft& draft) { return draft.sound(); });
    if (!sound || drafts.empty()) return;
    for (size_t i = 0; i < drafts.size(); ++i) {
      for (const GivenFactor& given : drafts[i].own.factors) {
        const std::string why = WhyWithoutEffect(given.factor.name, study.parts[i]);
        if (!why.empty()) reader_.AddFault(given.key, why);
      }
    }
    for (const GivenFactor& given : drafts.front().common.factors) {
      const std::string& name = given.factor.name;
      const bool idle = std::all_of(
          study.parts.begin(), study.parts.end(),
          [&name](const StudyPart& part) { return !WhyWithoutEffect(name, part).empty(); });
      if (idle) reader_.AddFault(given.key, name + " has no effect in any part");
    }
    CheckCorrelationsOfAll(study, drafts);
    for (const GivenDetector& given : drafts.front().common.detectors.value_or(NoDetectors())) {
      const SensorKind sensor = given.choice.sensor;
      const bool idle =
          std::none_of(study.parts.begin(), study.parts.end(), [sensor](const StudyPart& part) {
            return std::find(part.sensors.begin(), part.sensors.end(), sensor) !=
                   part.sensors.end();
          });
      if (idle) {
        reader_.AddFault(given.node, fmt::format("{} works on {}, which no part uses",
                                                 given.choice.name, ToString(sensor)));
      }
    }
  }

  // Those that the study gives, in some part.
  void CheckCorrelationsOfAll(const Study& study, const std::vector<PartDraft>& drafts) {
    if (!drafts.front().common.design) return;
    const GivenDesign& given = *drafts.front().common.design;
    for (size_t i = 0; i < given.design.correlations.size(); ++i) {
      const FactorCorrelation& correlation = given.design.correlations[i];
      const bool idle =
          std::none_of(study.parts.begin(), study.parts.end(), [&](const StudyPart& part) {
            const auto& known = part.design.correlations;
            return std::find(known.begin(), known.end(), correlation) != known.end();
          });
      if (!idle) continue;
      reader_.AddFault(given.correlation_nodes[i],
                       fmt::format("no part draws both {} and {} from distributions",
                                   correlation.first, correlation.second));
    }
  }

  static std::vector<GivenDetector> NoDetectors() { return {}; }

  void CheckSize(const Study& study) {
    const auto note = [this](const char* key, const std::string& message) {
      const YAML::Node& root = reader_.root();
      reader_.AddFault(root[key].IsDefined() ? root[key] : root, message);
    };
    if (CountCells(study) > kMostCells) {
      note("factors", fmt::format("the study has {} cells; at most {} are allowed",
                                  CountCells(study), kMostCells));
    } else if (CountTrials(study) > kMostTrials) {
      note("repetitions", fmt::format("the study has {} trials; at most {} are allowed",
                                      CountTrials(study), kMostTrials));
    }
  }

  void CheckContradictions(const Study& study, const std::vector<PartDraft>& drafts) {
    for (const Contradiction& contradiction : FindContradictions(study)) {
      const PartDraft& draft = drafts[contradiction.part_index];
      const GivenFactor* given = draft.FindFactor(contradiction.factor);
      reader_.AddFault(
          given != nullptr ? given->key : draft.own.node,
          fmt::format("part '{}' contradicts itself: {}", draft.name, contradiction.message));
    }
  }

  YamlReader reader_;
  std::span<const DetectorInfo> known_;
};

std::vector<std::string> WithBlockKeys(std::vector<std::string> keys) {
  keys.insert(keys.end(), BlockKeys().begin(), BlockKeys().end());
  return keys;
}

}  // namespace

const std::vector<std::string>& StudyKeys() {
  static const std::vector<std::string> keys = WithBlockKeys(
      {"fenestra_version", "name", "description", "seed", "independent_cells", "parts"});
  return keys;
}

const std::vector<std::string>& PartKeys() {
  static const std::vector<std::string> keys = WithBlockKeys({"name"});
  return keys;
}

Study ReadStudy(YamlReader reader, std::span<const DetectorInfo> known_detectors) {
  return StudyReader(std::move(reader), known_detectors).Read();
}

Study ReadStudyFile(const std::filesystem::path& file,
                    std::span<const DetectorInfo> known_detectors) {
  return ReadStudy(YamlReader::FromFile(file), known_detectors);
}

}  // namespace fenestra
