#include "experiments/sequence/sequence_writer.h"

#include <fmt/format.h>

#include "core/detection/observation.h"
#include "core/io/input_error.h"
#include "core/io/temporary_files.h"
#include "core/io/yaml_reader.h"
#include "experiments/sequence/sequence.h"
#include "experiments/trial/cell_runner.h"

namespace fenestra {
namespace {

std::string FactorsYaml(const FactorValues& factors) {
  std::string text;
  for (const auto& [name, value] : factors) {
    const std::string* word = std::get_if<std::string>(&value);
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", name,
                        word != nullptr ? YamlQuoted(*word) : ToString(value));
  }
  return "{" + text + "}";
}

std::string FrameYaml(const SequenceFrame& frame) {
  const ObservationFiles& files = frame.files;
  const std::string images =
      files.sensor == SensorKind::kStereo
          ? fmt::format("left: {}\n    right: {}", files.left.string(), files.right.string())
          : fmt::format("color: {}\n    depth: {}", files.color.string(), files.depth.string());
  return fmt::format(
      "  - {}\n    calibration: {}\n    part: {}\n    levels: {}\n    drawn: {}\n    truth: {}\n",
      images, files.calibration.string(), frame.part, FactorsYaml(frame.levels),
      FactorsYaml(frame.drawn), ToYaml(frame.truth));
}

}  // namespace

std::string ToYaml(const Sequence& sequence) {
  std::string frames;
  for (const SequenceFrame& frame : sequence.frames) frames += FrameYaml(frame);
  return fmt::format("name: {}\ndescription: {}\nsensor: {}\nframes:\n{}", sequence.name,
                     YamlQuoted(sequence.description), ToString(sequence.sensor), frames);
}

int WriteSequence(const OutputPath& folder, const Study& study, SensorKind sensor) {
  Sequence sequence{.name = study.name,
                    .description = study.description,
                    .sensor = sensor,
                    .detectors = {},
                    .frames = {},
                    .text = ""};
  for (const Cell& cell : Cells(study)) {
    if (cell.sensor != sensor) continue;
    const CellRunner runner(study, cell);
    for (int trial = 0; trial < cell.repetitions; ++trial) {
      const SimulatedTrial simulated = runner.Simulate(trial);
      const std::string place = fmt::format("{:05}", sequence.frames.size());
      WriteObservation(folder / place, simulated.observation, simulated.calibration);
      sequence.frames.push_back({.cell = cell.index,
                                 .trial = trial,
                                 .part = cell.part,
                                 .levels = cell.levels,
                                 .drawn = simulated.trial.drawn,
                                 .files = ObservationFiles::In(place, sensor),
                                 .truth = simulated.truth});
    }
  }
  if (sequence.frames.empty()) {
    throw InputError("--sequence", fmt::format("study '{}' has no cell with sensor {}", study.name,
                                               ToString(sensor)));
  }
  WriteFileAtomically(folder / "sequence.yaml", ToYaml(sequence));
  return static_cast<int>(sequence.frames.size());
}

}  // namespace fenestra
