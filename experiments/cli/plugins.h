#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "experiments/cli/command_line.h"
#include "experiments/trial/detector_maker.h"

namespace fenestra::cli {

/// --plugin LIBRARY, as often as one likes.
void AddPluginOption(Command command, std::vector<std::filesystem::path>& plugins);

/// Throws InputError (see LoadPlugin).
void LoadPlugins(const std::vector<std::filesystem::path>& plugins);

/// Makes detectors, the isolated ones by starting this very program with these plugins.
std::shared_ptr<DetectorMaker> MakerWith(const std::vector<std::filesystem::path>& plugins);

}  // namespace fenestra::cli
