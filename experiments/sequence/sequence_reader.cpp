#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "experiments/sequence/sequence.h"
#include "experiments/store/record_json.h"
#include "experiments/study_file/detector_reader.h"
#include "experiments/study_file/study_blocks.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;

class SequenceReader {
 public:
  SequenceReader(YamlReader reader, fs::path folder)
      : reader_(std::move(reader)), folder_(std::move(folder)) {}

  Sequence Read() {
    const YAML::Node& root = reader_.root();
    static const std::vector<std::string> keys{"name",      "description", "sensor",
                                               "detectors", "calibration", "frames"};
    reader_.CheckKeys(root, "the sequence", keys);
    if (!root.IsMap()) reader_.ThrowIfFaulty();
    Sequence sequence = ReadHead(root);
    sequence.text = reader_.text();
    const YAML::Node frames = Required(root, "the sequence", "frames");
    if (frames.IsDefined() && (!frames.IsSequence() || frames.size() == 0)) {
      reader_.AddFault(frames, fmt::format("frames must be a list of at least one frame, not {}",
                                           YamlReader::Describe(frames)));
    } else if (frames.IsDefined()) {
      for (const YAML::Node& frame : frames) {
        if (auto read = ReadFrame(frame, sequence.sensor)) {
          sequence.frames.push_back(std::move(*read));
        }
      }
    }
    reader_.ThrowIfFaulty();
    return sequence;
  }

 private:
  // An undefined node, and a fault, where the key is missing.
  YAML::Node Required(const YAML::Node& node, const std::string& what, const std::string& key) {
    const YAML::Node found = node[key];
    if (!found.IsDefined()) reader_.AddFault(node, fmt::format("{} needs {}", what, key));
    return found;
  }

  Sequence ReadHead(const YAML::Node& root) {
    Sequence sequence;
    if (const YAML::Node name = Required(root, "the sequence", "name"); name.IsDefined()) {
      sequence.name = ReadName(reader_, name, "name").value_or("");
    }
    if (const YAML::Node text = root["description"]; text.IsDefined()) {
      sequence.description = reader_.Text(text, "description").value_or("");
    }
    const YAML::Node sensor = Required(root, "the sequence", "sensor");
    if (!sensor.IsDefined()) reader_.ThrowIfFaulty();
    const auto kind = ReadSensor(reader_, sensor);
    if (!kind) reader_.ThrowIfFaulty();
    sequence.sensor = *kind;
    sequence.detectors = ReadDetectorsOf(root, *kind);
    if (const YAML::Node file = root["calibration"]; file.IsDefined()) {
      calibration_ = ReadPath(file, "calibration");
    }
    return sequence;
  }

  std::vector<DetectorChoice> ReadDetectorsOf(const YAML::Node& root, SensorKind sensor) {
    std::vector<DetectorChoice> detectors;
    const YAML::Node given = root["detectors"];
    if (!given.IsDefined()) {
      for (const DetectorInfo& info : Detectors()) {
        if (info.sensor == sensor) detectors.push_back(DefaultChoice(info));
      }
      return detectors;
    }
    for (const GivenDetector& detector :
         ReadDetectors(reader_, given, Detectors()).value_or(std::vector<GivenDetector>{})) {
      detectors.push_back(detector.choice);
      if (detector.choice.sensor == sensor) continue;
      reader_.AddFault(detector.node,
                       fmt::format("{} works on {}, the sequence is of {}", detector.choice.name,
                                   ToString(detector.choice.sensor), ToString(sensor)));
    }
    return detectors;
  }

  fs::path ReadPath(const YAML::Node& node, const std::string& what) {
    const auto text = reader_.Text(node, what);
    if (!text) return {};
    fs::path path = folder_ / *text;
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
      reader_.AddFault(node, fmt::format("there is no file {}", path.string()));
    }
    return path;
  }

  std::optional<SequenceFrame> ReadFrame(const YAML::Node& node, SensorKind sensor) {
    const bool stereo = sensor == SensorKind::kStereo;
    const std::vector<std::string> images = stereo ? std::vector<std::string>{"left", "right"}
                                                   : std::vector<std::string>{"color", "depth"};
    std::vector<std::string> keys{"calibration", "truth", "part", "levels", "drawn"};
    keys.insert(keys.end(), images.begin(), images.end());
    reader_.CheckKeys(node, "a frame", keys);
    if (!node.IsMap()) return std::nullopt;
    SequenceFrame frame;
    frame.files = ReadFiles(node, images, sensor);
    frame.part = "main";
    if (const YAML::Node part = node["part"]; part.IsDefined()) {
      frame.part = ReadName(reader_, part, "a part's name").value_or("");
    }
    frame.levels = ReadFactors(node["levels"], "levels");
    frame.drawn = ReadFactors(node["drawn"], "drawn");
    if (const YAML::Node truth = Required(node, "a frame", "truth"); truth.IsDefined()) {
      frame.truth = ReadSurveyedTruth(reader_, truth);
    }
    std::tie(frame.cell, frame.trial) = Place(frame.part, frame.levels);
    return frame;
  }

  ObservationFiles ReadFiles(const YAML::Node& node, const std::vector<std::string>& images,
                             SensorKind sensor) {
    ObservationFiles files;
    files.sensor = sensor;
    std::vector<fs::path> paths;
    for (const std::string& image : images) {
      const YAML::Node path = Required(node, "a frame", image);
      paths.push_back(path.IsDefined() ? ReadPath(path, image) : fs::path());
    }
    (sensor == SensorKind::kStereo ? files.left : files.color) = paths[0];
    (sensor == SensorKind::kStereo ? files.right : files.depth) = paths[1];
    files.calibration = calibration_;
    if (const YAML::Node own = node["calibration"]; own.IsDefined()) {
      files.calibration = ReadPath(own, "calibration");
    } else if (calibration_.empty()) {
      reader_.AddFault(node, "a frame needs calibration, or the sequence one for all frames");
    }
    return files;
  }

  FactorValues ReadFactors(const YAML::Node& node, const std::string& what) {
    FactorValues values;
    if (!node.IsDefined()) return values;
    if (!node.IsMap()) {
      reader_.AddFault(node, fmt::format("{} must be a mapping (name: value), not {}", what,
                                         YamlReader::Describe(node)));
      return values;
    }
    std::set<std::string> seen;
    for (const auto& entry : node) {
      const auto name = ReadName(reader_, entry.first, "a name in " + what);
      if (!name) continue;
      if (!seen.insert(*name).second) {
        reader_.AddFault(entry.first, fmt::format("'{}' stands twice in {}", *name, what));
        continue;
      }
      if (const auto value = ReadFreeValue(reader_, entry.second, *name)) {
        values.emplace_back(*name, *value);
      }
    }
    return values;
  }

  // The next frame's cell, and its number in it.
  std::pair<int, int> Place(const std::string& part, const FactorValues& levels) {
    const auto [place, is_new] = cells_.try_emplace(part + FactorsToJson(levels),
                                                    std::pair(static_cast<int>(cells_.size()), 0));
    return {place->second.first, place->second.second++};
  }

  YamlReader reader_;
  fs::path folder_;
  fs::path calibration_;
  std::map<std::string, std::pair<int, int>> cells_;  ///< Of part and levels: index and size.
};

}  // namespace

Sequence ReadSequence(const fs::path& file) {
  return SequenceReader(YamlReader::FromFile(file), file.parent_path()).Read();
}

}  // namespace fenestra
