#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <memory>

#include "core/io/input_error.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/run/replay.h"

namespace fenestra::cli {
namespace {

struct ReplayArguments {
  std::filesystem::path results;
  std::string trial;  ///< "CELL/TRIAL"
  std::filesystem::path out;
  std::vector<std::filesystem::path> plugins;
};

struct CellAndTrial {
  int cell;
  int trial;
};

CellAndTrial ParseTrial(const std::string& text) {
  CellAndTrial key{};
  const char* end = text.data() + text.size();
  const auto cell = std::from_chars(text.data(), end, key.cell);
  if (cell.ec == std::errc() && cell.ptr != end && *cell.ptr == '/') {
    const auto trial = std::from_chars(cell.ptr + 1, end, key.trial);
    if (trial.ec == std::errc() && trial.ptr == end) return key;
  }
  throw InputError("CELL/TRIAL",
                   fmt::format("must be two whole numbers such as 7/3, not '{}'", text));
}

std::string Describe(const Score& score) {
  const auto error = score.CentroidError_C();
  if (!error) {
    return fmt::format("{}{}", ToString(score.outcome),
                       score.reason.empty() ? "" : " (" + score.reason + ": " + score.detail + ")");
  }
  return fmt::format("{}, centroid error {:.2f} mm (x {:.2f}, y {:.2f}, z {:.2f})",
                     ToString(score.outcome), 1e3 * error->norm(), 1e3 * error->x(),
                     1e3 * error->y(), 1e3 * error->z());
}

int Replay(const ReplayArguments& arguments) {
  const CellAndTrial key = ParseTrial(arguments.trial);
  LoadPlugins(arguments.plugins);
  bool same = true;
  for (const ReplayedRow& row : fenestra::Replay(arguments.results, key.cell, key.trial,
                                                 arguments.out, MakerWith(arguments.plugins))) {
    fmt::print("{}/{} {}: {}\n", key.cell, key.trial, row.recorded.detector,
               Describe(row.repeated.score));
    for (const auto& [name, value] : row.recorded.levels) {
      fmt::print("    {} = {}\n", name, ToString(value));
    }
    for (const auto& [name, value] : row.recorded.drawn) {
      fmt::print("    {} = {} (drawn)\n", name, ToString(value));
    }
    for (const StageTime& time : row.repeated.stages) {
      fmt::print("    {:<12} {:7.1f} ms\n", time.stage, 1e3 * time.seconds);
    }
    for (const std::string& difference : row.differences)
      fmt::print("    DIFFERS: {}\n", difference);
    same = same && row.differences.empty();
  }
  if (!same) {
    fmt::print(
        "The numbers differ from the recorded ones: another version, processor, library "
        "or folder?\n");
    return kFailure;
  }
  fmt::print("The numbers equal the recorded ones to the last bit.\n");
  return kDone;
}

}  // namespace

void AddReplayCommand(Command program) {
  Command command = program.AddCommand("replay", "Runs one recorded trial again");
  command.Footer(
      "Example:\n"
      "  fenestra replay results/paper 7/3 --out /tmp/trial\n"
      "With --out, DIR gets the trial's files as 'render' writes them, and every stage picture.");
  const auto arguments = std::make_shared<ReplayArguments>();
  command.AddOption("RESULTS", arguments->results, "Results folder or its results.sqlite")
      .Required();
  command.AddOption("CELL/TRIAL", arguments->trial, "Which trial, for example 7/3").Required();
  command.AddOption("--out", arguments->out, "Folder for pictures and files");
  AddPluginOption(command, arguments->plugins);
  command.Action([arguments] { return Replay(*arguments); });
}

}  // namespace fenestra::cli
