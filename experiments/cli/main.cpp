#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "core/did_you_mean.h"
#include "core/freed_memory.h"
#include "core/input_error.h"
#include "core/program.h"
#include "experiments/cli/commands.h"
#include "experiments/library_versions.h"

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
    "Exit codes: 0 done, 1 a checked bound is violated, 2 input error, 3 anything else.";

// The innermost command that was named on the command line.
const CLI::App* Innermost(const CLI::App* app) {
  const auto named = app->get_subcommands();
  return named.empty() ? app : Innermost(named.front());
}

std::vector<std::string> KnownFlags(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  }
  return flags;
}

std::vector<std::string> KnownCommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

// What is wrong with the command line, with a hint for every word that is unknown.
int ReportParseError(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* app = Innermost(&program);
  const std::vector<std::string> unknown = app->remaining(true);
  const auto is_flag = [](const std::string& word) { return word.starts_with("-"); };
  const bool flags = std::any_of(unknown.begin(), unknown.end(), is_flag);
  for (const std::string& word : unknown) {
    const bool flag = is_flag(word);
    if (flags && !flag) continue;  // Most likely the value of an unknown option.
    const std::vector<std::string> known = flag ? KnownFlags(*app) : KnownCommands(*app);
    const std::string name = word.substr(0, word.find('='));
    fmt::print(stderr, "fenestra: unknown {} '{}'.{}\n", flag ? "option" : "argument", word,
               DidYouMean(name, known));
  }
  if (unknown.empty()) fmt::print(stderr, "fenestra: {}\n", error.what());
  std::string command = "fenestra";
  for (const CLI::App* at = &program; at != app;) {
    at = at->get_subcommands().front();
    command += " " + at->get_name();
  }
  fmt::print(stderr, "See '{} --help'.\n", command);
  return kInputError;
}

int Main(int argc, char** argv) {
  // Trials run in parallel; a single trial is single-threaded, or its times would mean nothing.
  cv::setNumThreads(1);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);

  CLI::App program(kDescription, "fenestra");
  program.footer(kExamples);
  program.require_subcommand(1);
  program.set_version_flag(
      "--version", [] { return fmt::format("fenestra {} ({})", Version(), LibraryVersions()); });
  int exit_code = kDone;
  AddRunCommand(program, exit_code);
  AddCheckCommand(program, exit_code);
  AddRenderCommand(program, exit_code);
  AddExportCommand(program, exit_code);
  AddReplayCommand(program, exit_code);
  AddReportCommand(program, exit_code);
  AddMergeCommand(program, exit_code);
  AddSubmitCommand(program, exit_code);
  AddDetectCommand(program, exit_code);
  AddBoundCommand(program, exit_code);
  AddCalibrateCommand(program, exit_code);
  AddEmvaCommand(program, exit_code);
  AddDepthCommand(program, exit_code);
  AddScoreCommand(program, exit_code);
  AddServeCommand(program, exit_code);
  AddRatiosCommand(program, exit_code);
  AddFixturesCommand(program, exit_code);
  AddStudyCommand(program, exit_code);
  AddListCommand(program, exit_code);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      return program.exit(error);  // --help, --version
    }
    return ReportParseError(program, error);
  }
  return exit_code;
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
