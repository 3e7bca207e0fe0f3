#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/detection/observation.h"
#include "core/io/parameter_table.h"
#include "experiments/study/trial_settings.h"

namespace fenestra {

/// The group of a factor, which says where it has an effect.
enum class FactorGroup {
  kViewpoint,  ///< Where the rig stands and looks.
  kScene,      ///< The window and the wall, in every kind of scene.
  kFacade,     ///< Parts that only the facade has; no effect on the painted target.
  kLight,
  kStereo,  ///< Named stereo_*; no effect on the RGB-D sensor.
  kRgbd,    ///< Named rgbd_*; no effect on the stereo rig.
};

/// Every setting of a trial that a study may vary, with its unit in its name, its range and one
/// line of description. The ranges keep the models within what they were made for; settings that
/// contradict each other inside their ranges are found by Validate.
const ParameterTable<TrialSettings>& Factors();

/// The factor must exist.
FactorGroup GroupOf(const std::string& factor);

/// Whether trials with this sensor can depend on factors of the group.
bool Concerns(FactorGroup group, SensorKind sensor);

/// Values of factors by name, in an order that means something to their reader.
using FactorValues = std::vector<std::pair<std::string, ParameterValue>>;

/// All values in one line, as tables, CSV files and messages show them: "distance_m 2, yaw_deg 10".
/// `is` stands between a name and its value; " = " gives the conditions of a check.
std::string LevelsText(const FactorValues& levels, std::string_view is = " ");

/// The value of one of them as a table shows it; empty if `levels` has none of this name.
std::string LevelText(const FactorValues& levels, const std::string& name);

}  // namespace fenestra
