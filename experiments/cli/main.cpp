#include <fmt/format.h>

#include <exception>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "core/io/input_error.h"
#include "core/system/program.h"
#include "experiments/cli/commands.h"
#include "experiments/run/run_identity.h"

namespace fenestra::cli {
namespace {

constexpr const char* kDescription =
    "Fenestra: how well, and until where, does a vision pipeline find a window?\n"
    "It renders a facade, models the sensors, runs the detectors and scores them against the "
    "truth.";

constexpr const char* kExamples =
    "Examples:\n"
    "  fenestra run paper                      the paper's experiment, with its accuracy table\n"
    "  fenestra run paper --trials 100         the same with 100 trials per cell\n"
    "  fenestra replay results/paper 7/3       one recorded trial again\n"
    "  fenestra list factors                   all that a study can vary\n"
    "Exit codes: 0 done, 1 a checked limit is violated, 2 input error, 3 anything else.";

int Main(int argc, char** argv) {
  // Trials run in parallel; a single trial is single-threaded, or its times would mean nothing.
  cv::setNumThreads(1);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);

  CommandLineParser parser("fenestra", kDescription);
  parser.SetVersion([] { return fmt::format("fenestra {} ({})", Version(), LibraryVersions()); });
  Command program = parser.program();
  program.Footer(kExamples);
  program.RequireCommand();
  AddRunCommand(program);
  AddCheckCommand(program);
  AddRenderCommand(program);
  AddExportCommand(program);
  AddReplayCommand(program);
  AddReportCommand(program);
  AddMergeCommand(program);
  AddSubmitCommand(program);
  AddDetectCommand(program);
  AddBoundCommand(program);
  AddCalibrateCommand(program);
  AddEmvaCommand(program);
  AddDepthCommand(program);
  AddScoreCommand(program);
  AddServeCommand(program);
  AddRatiosCommand(program);
  AddPoolCommand(program);
  AddFixturesCommand(program);
  AddStudyCommand(program);
  AddListCommand(program);
  return parser.Run(argc, argv);
}

}  // namespace
}  // namespace fenestra::cli

int main(int argc, char** argv) {
  fenestra::KeepFreedMemory();
  try {
    return fenestra::cli::Main(argc, argv);
  } catch (const fenestra::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return fenestra::cli::kInputError;
  } catch (const std::exception& error) {
    fmt::print(stderr, "fenestra: {}\n", error.what());
    return fenestra::cli::kFailure;
  }
}
