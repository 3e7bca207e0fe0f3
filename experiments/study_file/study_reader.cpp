#include "experiments/study_file/study_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "experiments/study_file/detector_reader.h"
#include "experiments/study_file/part_reader.h"
#include "experiments/study_file/study_check.h"

namespace fenestra {
namespace {

class StudyReader {
 public:
  StudyReader(YamlReader reader, std::span<const DetectorInfo> known)
      : reader_(std::move(reader)), known_(known) {}

  Study Read() {
    const YAML::Node& root = reader_.root();
    reader_.CheckKeys(root, "the study", StudyKeys());
    if (!root.IsMap()) reader_.ThrowIfFaulty();
    Study study = ReadHead(root);
    const std::vector<PartDraft> drafts = ReadParts(reader_, known_);
    for (const PartDraft& draft : drafts) {
      study.parts.push_back(ResolvePart(reader_, draft, known_));
    }
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

}  // namespace

const std::vector<std::string>& StudyKeys() {
  static const std::vector<std::string> keys = WithBlockKeys(
      {"fenestra_version", "name", "description", "seed", "independent_cells", "parts"});
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
