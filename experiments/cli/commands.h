#pragma once

#include <CLI/CLI.hpp>

namespace fenestra::cli {

/// Exit codes of the program.
enum ExitCode : int {
  kDone = 0,
  kBoundViolated = 1,
  kInputError = 2,
  kFailure = 3,
};

/// Accepts finite numbers above 0. CLI11's own validator names the largest double in its message.
CLI::Validator Positive();

/// Each adds one command to the program. A command runs when the command line has been parsed and
/// leaves the program's exit code in `exit_code`.
void AddRunCommand(CLI::App& program, int& exit_code);
void AddRenderCommand(CLI::App& program, int& exit_code);
void AddExportCommand(CLI::App& program, int& exit_code);
void AddReplayCommand(CLI::App& program, int& exit_code);
void AddReportCommand(CLI::App& program, int& exit_code);
void AddMergeCommand(CLI::App& program, int& exit_code);
void AddSubmitCommand(CLI::App& program, int& exit_code);
void AddDetectCommand(CLI::App& program, int& exit_code);
void AddBoundCommand(CLI::App& program, int& exit_code);
void AddCalibrateCommand(CLI::App& program, int& exit_code);
void AddEmvaCommand(CLI::App& program, int& exit_code);
void AddCheckCommand(CLI::App& program, int& exit_code);
void AddDepthCommand(CLI::App& program, int& exit_code);
void AddScoreCommand(CLI::App& program, int& exit_code);
void AddServeCommand(CLI::App& program, int& exit_code);
void AddRatiosCommand(CLI::App& program, int& exit_code);
void AddFixturesCommand(CLI::App& program, int& exit_code);
void AddListCommand(CLI::App& program, int& exit_code);
void AddStudyCommand(CLI::App& program, int& exit_code);

}  // namespace fenestra::cli
