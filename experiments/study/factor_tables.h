#pragma once

#include <string>

#include "core/io/parameter_table.h"
#include "experiments/study/trial_settings.h"

namespace fenestra {

/// The tables that Factors joins. Those of the facade and of the sensors have files of their own:
/// facade_factors.cpp, stereo_factors.cpp, stereo_image_factors.cpp and rgbd_factors.cpp.
using FactorTable = ParameterTable<TrialSettings>;

/// SI per unit of a factor's name.
inline constexpr double kMilli = 1e-3;
inline constexpr double kMicro = 1e-6;
inline constexpr double kPercent = 1e-2;

/// Where the rig stands and how it is turned.
void AddViewpointFactors(FactorTable& table);
/// The window and the wall, in every kind of scene.
void AddSceneFactors(FactorTable& table);
/// Everything that only the facade has: its wall's texture, its windows' parts, the other windows,
/// the rooms and all that hangs before the wall.
void AddFacadeFactors(FactorTable& table);
/// Sun, sky and ground.
void AddLightFactors(FactorTable& table);
/// The stereo cameras, the rig that they form and its calibration.
void AddStereoFactors(FactorTable& table);
/// Lenses, exposure and sensors of the stereo cameras.
void AddStereoImageFactors(FactorTable& table);
/// The depth and the colour camera of the RGB-D sensor.
void AddRgbdFactors(FactorTable& table);
/// Its colour camera.
void AddRgbdColorFactors(FactorTable& table);

/// The velocity and the rates of turn of one sensor's rig, which `of` finds in the settings. Names
/// begin with that of the sensor: "stereo_speed_right_m_s".
void AddMotionFactors(FactorTable& table, const std::string& sensor,
                      FactorTable::Field<RigMotion> of);

}  // namespace fenestra
