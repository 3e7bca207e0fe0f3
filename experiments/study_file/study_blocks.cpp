#include "experiments/study_file/study_blocks.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/faults.h"
#include "experiments/study/factors.h"
#include "experiments/study_file/detector_reader.h"
#include "experiments/study_file/factor_reader.h"
#include "experiments/study_file/rule_reader.h"

namespace fenestra {
namespace {

std::optional<std::vector<SensorKind>> ReadSensors(YamlReader& reader, const YAML::Node& node) {
  if (!node.IsSequence() || node.size() == 0) {
    reader.AddFault(node, fmt::format("sensors must be a list such as [stereo, rgbd], not {}",
                                      YamlReader::Describe(node)));
    return std::nullopt;
  }
  const size_t before = reader.fault_count();
  std::vector<SensorKind> sensors;
  for (const YAML::Node& item : node) {
    const auto sensor = ReadSensor(reader, item);
    if (!sensor) continue;
    if (std::find(sensors.begin(), sensors.end(), *sensor) != sensors.end()) {
      reader.AddFault(item, fmt::format("the sensor '{}' stands twice", ToString(*sensor)));
    }
    sensors.push_back(*sensor);
  }
  return reader.IfSoundSince(before, sensors);
}

std::vector<GivenFactor> ReadFactors(YamlReader& reader, const YAML::Node& node) {
  std::vector<GivenFactor> given;
  reader.CheckKeys(node, "factors", Factors().Names());
  if (!node.IsMap()) return given;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) continue;  // CheckKeys has noted it, as it has unknown names.
    const ParameterInfo* info = Factors().Find(entry.first.Scalar());
    if (info == nullptr) continue;
    if (entry.second.IsNull()) {  // A missing value's position is that of whatever comes next.
      reader.AddFault(entry.first,
                      fmt::format("{} must be {}, not nothing", info->name, info->Allowed()));
      continue;
    }
    if (const auto setting = ReadFactorSetting(reader, *info, entry.second)) {
      given.push_back({{info->name, *setting}, entry.first});
    }
  }
  return given;
}

}  // namespace

const GivenFactor* StudyBlock::FindFactor(const std::string& name) const {
  const auto found =
      std::find_if(factors.begin(), factors.end(),
                   [&name](const GivenFactor& given) { return given.factor.name == name; });
  return found == factors.end() ? nullptr : &*found;
}

const std::vector<std::string>& BlockKeys() {
  static const std::vector<std::string> keys{"repetitions", "sensors",  "detectors", "design",
                                             "until",       "envelope", "factors"};
  return keys;
}

std::vector<std::string> WithBlockKeys(std::vector<std::string> keys) {
  keys.insert(keys.end(), BlockKeys().begin(), BlockKeys().end());
  return keys;
}

StudyBlock ReadBlock(YamlReader& reader, const YAML::Node& node,
                     std::span<const DetectorInfo> known_detectors) {
  StudyBlock block;
  block.node = node;
  const size_t before = reader.fault_count();
  if (const YAML::Node repetitions = node["repetitions"]; repetitions.IsDefined()) {
    const auto count = reader.Integer(repetitions, "repetitions", 1, kMostTrials);
    if (count) block.repetitions = static_cast<int>(*count);
  }
  if (const YAML::Node sensors = node["sensors"]; sensors.IsDefined()) {
    block.sensors = ReadSensors(reader, sensors);
  }
  if (const YAML::Node detectors = node["detectors"]; detectors.IsDefined()) {
    block.detectors = ReadDetectors(reader, detectors, known_detectors);
  }
  if (const YAML::Node design = node["design"]; design.IsDefined()) {
    block.design = ReadDesign(reader, design);
  }
  if (const YAML::Node until = node["until"]; until.IsDefined()) {
    block.until = ReadStoppingRule(reader, until);
  }
  if (const YAML::Node envelope = node["envelope"]; envelope.IsDefined()) {
    block.envelope = ReadEnvelopeRule(reader, envelope);
  }
  block.sound = reader.fault_count() == before;
  if (const YAML::Node factors = node["factors"]; factors.IsDefined()) {
    block.factors = ReadFactors(reader, factors);
    block.sound = block.sound && block.factors.size() == factors.size();
  }
  return block;
}

}  // namespace fenestra
