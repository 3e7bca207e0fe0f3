#pragma once

#include "experiments/cli/command_line.h"

namespace fenestra::cli {

/// Each adds one command to the program.
void AddRunCommand(Command program);
void AddRenderCommand(Command program);
void AddExportCommand(Command program);
void AddReplayCommand(Command program);
void AddReportCommand(Command program);
void AddMergeCommand(Command program);
void AddSubmitCommand(Command program);
void AddDetectCommand(Command program);
void AddBoundCommand(Command program);
void AddCalibrateCommand(Command program);
void AddEmvaCommand(Command program);
void AddCheckCommand(Command program);
void AddDepthCommand(Command program);
void AddScoreCommand(Command program);
void AddServeCommand(Command program);
void AddRatiosCommand(Command program);
void AddPoolCommand(Command program);
void AddFixturesCommand(Command program);
void AddListCommand(Command program);
void AddStudyCommand(Command program);
void AddValidateCommand(Command program);

}  // namespace fenestra::cli
