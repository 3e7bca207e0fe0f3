#include "experiments/study_file/name_reader.h"

#include <fmt/format.h>

namespace fenestra {

std::optional<SensorKind> ReadSensor(YamlReader& reader, const YAML::Node& node) {
  const auto name = reader.Text(node, "a sensor");
  if (!name) return std::nullopt;
  const auto sensor = ParseSensorKind(*name);
  if (!sensor) {
    reader.AddFault(node, fmt::format("unknown sensor '{}'. Known: {}, {}.", *name,
                                      ToString(SensorKind::kStereo), ToString(SensorKind::kRgbd)));
  }
  return sensor;
}

std::optional<std::string> ReadName(YamlReader& reader, const YAML::Node& node,
                                    const std::string& what) {
  const auto name = reader.Text(node, what);
  if (!name) return std::nullopt;
  const bool good =
      !name->empty() && name->size() <= 64 &&
      name->find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string::npos;
  if (good) return name;
  reader.AddFault(node, fmt::format("{} must be 1 to 64 of the characters a-z 0-9 _ -, not {}",
                                    what, YamlReader::Describe(node)));
  return std::nullopt;
}

}  // namespace fenestra
