#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/cli/command_line.h"
#include "experiments/study/study.h"
#include "experiments/trial/detector_maker.h"

namespace fenestra::cli {

/// A detector as the command line names it.
struct DetectorArguments {
  std::string detector;
  std::vector<std::string> options;  ///< "name=value"
  std::string command;               ///< "[python3, mine.py]", or a program without arguments.
  bool isolate = false;
  std::optional<double> time_limit_s;
  std::vector<std::filesystem::path> plugins;
};

/// --detector, --option, --command, --isolate, --time-limit-s, --plugin.
void AddDetectorOptions(Command command, DetectorArguments& arguments);

/// Loads the plugins and finds the detector. Throws InputError for what does not exist, does not
/// work on the sensor or has no such option.
DetectorChoice ChooseDetector(const DetectorArguments& arguments, SensorKind sensor);

/// Notes on standard error that the unit of 1 mm is assumed, where an RGB-D calibration states
/// none.
void NoteAssumedDepthUnit(const std::filesystem::path& calibration);

/// --plugin LIBRARY, as often as one likes.
void AddPluginOption(Command command, std::vector<std::filesystem::path>& plugins);

/// Throws InputError (see LoadPlugin).
void LoadPlugins(const std::vector<std::filesystem::path>& plugins);

/// Makes detectors, the isolated ones by starting this very program with these plugins.
std::shared_ptr<DetectorMaker> MakerWith(const std::vector<std::filesystem::path>& plugins);

}  // namespace fenestra::cli
