#include "experiments/sequence_writer.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/atomic_file.h"
#include "core/input_error.h"
#include "core/observation_files.h"
#include "experiments/cell_bench.h"
#include "experiments/surveyed_truth.h"

namespace fenestra {
namespace {

std::string Quoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

std::string FactorsYaml(const FactorValues& factors) {
  std::string text;
  for (const auto& [name, value] : factors) {
    const std::string* word = std::get_if<std::string>(&value);
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", name,
                        word != nullptr ? Quoted(*word) : ToString(value));
  }
  return "{" + text + "}";
}

std::string FrameYaml(const std::string& place, const Cell& cell, const SimulatedTrial& simulated) {
  const auto files = ObservationFiles::In(place, cell.sensor);
  const std::string images =
      cell.sensor == SensorKind::kStereo
          ? fmt::format("left: {}\n    right: {}", files.left.string(), files.right.string())
          : fmt::format("color: {}\n    depth: {}", files.color.string(), files.depth.string());
  return fmt::format(
      "  - {}\n    calibration: {}\n    part: {}\n    levels: {}\n    drawn: {}\n    truth: {}\n",
      images, files.calibration.string(), cell.part, FactorsYaml(cell.levels),
      FactorsYaml(simulated.trial.drawn), ToYaml(simulated.truth));
}

}  // namespace

int WriteSequence(const std::filesystem::path& folder, const Study& study, SensorKind sensor) {
  std::string frames;
  int count = 0;
  for (const Cell& cell : Cells(study)) {
    if (cell.sensor != sensor) continue;
    const CellBench bench(study, cell);
    for (int trial = 0; trial < cell.repetitions; ++trial, ++count) {
      const SimulatedTrial simulated = bench.Simulate(trial);
      const std::string place = fmt::format("{:05}", count);
      WriteObservation(folder / place, simulated.observation, simulated.calibration);
      frames += FrameYaml(place, cell, simulated);
    }
  }
  if (count == 0) {
    throw InputError("--sequence", fmt::format("study '{}' has no cell with sensor {}", study.name,
                                               ToString(sensor)));
  }
  WriteFileAtomically(folder / "sequence.yaml",
                      fmt::format("name: {}\ndescription: {}\nsensor: {}\nframes:\n{}", study.name,
                                  Quoted(study.description), ToString(sensor), frames));
  return count;
}

}  // namespace fenestra
