#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "core/io/input_error.h"
#include "core/system/program.h"
#include "experiments/cli/commands.h"
#include "experiments/run/run_identity.h"
#include "experiments/store/lock_wait.h"

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

// A file that is opened later must not become standard output because that was closed.
void OpenStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The wrong way round, so that using it fails as it does on a closed one.
    const int way = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", way) != stream) std::abort();
  }
}

// What was written last stays in a buffer until somebody asks.
bool OutputArrived() {
  std::cout.flush();
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
}

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
  AddValidateCommand(program);
  return parser.Run(argc, argv);
}

}  // namespace
}  // namespace fenestra::cli

int main(int argc, char** argv) {
  using namespace fenestra;
  cli::OpenStandardStreams();
  KeepFreedMemory();
  SetLockPatience({.notice = cli::Tell});
  int exit_code = cli::kFailure;
  try {
    exit_code = cli::Main(argc, argv);
  } catch (const InputError& error) {
    cli::Tell(error.what());
    exit_code = cli::kInputError;
  } catch (const std::exception& error) {
    cli::Tell(fmt::format("fenestra: {}", error.what()));
  }
  if (cli::OutputArrived()) return exit_code;
  cli::Tell("fenestra: standard output cannot be written");
  return cli::kFailure;
}
