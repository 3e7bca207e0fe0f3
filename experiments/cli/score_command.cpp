#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/io/input_error.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/report/report.h"
#include "experiments/sequence/score_sequence.h"

namespace fenestra::cli {
namespace {

struct ScoreArguments {
  std::filesystem::path sequence;
  std::filesystem::path out;
  bool restart = false;
  std::vector<std::string> detectors;
  std::vector<std::string> detections;  ///< "label=file"
  std::vector<std::filesystem::path> plugins;
};

// The detectors of the sequence that were asked for; all, unless any or detections were.
std::vector<DetectorChoice> Asked(const ScoreArguments& arguments, const Sequence& sequence) {
  if (arguments.detectors.empty()) {
    return arguments.detections.empty() ? sequence.detectors : std::vector<DetectorChoice>{};
  }
  std::vector<DetectorChoice> asked;
  for (const std::string& label : arguments.detectors) {
    const auto found = std::find_if(sequence.detectors.begin(), sequence.detectors.end(),
                                    [&label](const auto& d) { return d.label == label; });
    if (found == sequence.detectors.end()) {
      std::vector<std::string> labels;
      for (const DetectorChoice& detector : sequence.detectors) labels.push_back(detector.label);
      throw InputError("--detector", fmt::format("the sequence has no detector '{}'. Known: {}.",
                                                 label, fmt::join(labels, ", ")));
    }
    asked.push_back(*found);
  }
  return asked;
}

MadeDetections Made(const std::string& argument, size_t frames) {
  const size_t equals = argument.find('=');
  if (equals == std::string::npos || !IsDetectorName(argument.substr(0, equals))) {
    throw InputError("--detections", fmt::format("'{}' is not LABEL=FILE", argument));
  }
  return ReadDetections(argument.substr(0, equals), argument.substr(equals + 1), frames);
}

void CheckLabels(const SequenceRun& run) {
  std::vector<std::string> labels;
  for (const DetectorChoice& choice : run.sequence.detectors) labels.push_back(choice.label);
  for (const MadeDetections& made : run.made) labels.push_back(made.label);
  std::sort(labels.begin(), labels.end());
  const auto twice = std::adjacent_find(labels.begin(), labels.end());
  if (twice != labels.end()) throw InputError(*twice, "stands twice among the detectors");
}

void NoteAssumedDepthUnits(const Sequence& sequence) {
  if (sequence.sensor != SensorKind::kRgbd) return;
  std::set<std::filesystem::path> calibrations;
  for (const SequenceFrame& frame : sequence.frames) calibrations.insert(frame.files.calibration);
  for (const std::filesystem::path& file : calibrations) NoteAssumedDepthUnit(file);
}

void Score(const ScoreArguments& arguments) {
  LoadPlugins(arguments.plugins);
  SequenceRun run{.sequence = ReadSequence(arguments.sequence),
                  .made = {},
                  .out = arguments.out,
                  .restart = arguments.restart,
                  .detectors = MakerWith(arguments.plugins)};
  run.sequence.detectors = Asked(arguments, run.sequence);
  for (const std::string& argument : arguments.detections) {
    run.made.push_back(Made(argument, run.sequence.frames.size()));
  }
  CheckLabels(run);
  if (run.out.empty()) run.out = std::filesystem::path("results") / run.sequence.name;
  NoteAssumedDepthUnits(run.sequence);
  const std::vector<CellSummary> summaries = ScoreSequence(run);
  fmt::print("{}\nTables and rows are in {}\n", SummaryForTerminal(summaries), run.out.string());
}

}  // namespace

void AddScoreCommand(Command program) {
  Command command =
      program.AddCommand("score", "Compares detections on a recorded sequence with surveyed truth");
  command.Footer(
      "Example:\n"
      "  fenestra score corridor/sequence.yaml --detector edge-stereo --out /tmp/corridor\n"
      "  fenestra score corridor/sequence.yaml --detections mine=mine.json\n"
      "SEQUENCE lists the frames and what was surveyed of each; docs/score.md says how.");
  const auto arguments = std::make_shared<ScoreArguments>();
  command.AddOption("SEQUENCE", arguments->sequence, "File that lists the frames").Required();
  command.AddOption("--out", arguments->out, "Results folder; default: results/<name>");
  command.AddFlag("--restart", arguments->restart, "Replace another result that is there");
  command
      .AddOption("--detector", arguments->detectors,
                 "Only this one of the sequence's detectors; may be given several times")
      .OneValueEach();
  command
      .AddOption("--detections", arguments->detections,
                 "LABEL=FILE: what 'detect --json' printed, frame by frame")
      .OneValueEach();
  AddPluginOption(command, arguments->plugins);
  command.Action([arguments] {
    Score(*arguments);
    return kDone;
  });
}

}  // namespace fenestra::cli
