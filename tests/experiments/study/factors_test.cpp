#include "experiments/study/factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

using Type = ParameterInfo::Type;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Values that tell a factor's field from all others.
std::vector<ParameterValue> SomeValues(const ParameterInfo& info) {
  if (info.type == Type::kSwitch) return {false, true};
  if (info.type == Type::kChoice) return {info.choices.begin(), info.choices.end()};
  const double middle = 0.5 * (info.min + info.max);
  return {info.min, info.type == Type::kInteger ? std::floor(middle) : middle, info.max};
}

// A number goes to SI and back, which rounds twice: two units in the last place.
void ExpectSame(const ParameterValue& read, const ParameterValue& set, const std::string& name) {
  const double* number = std::get_if<double>(&set);
  if (number == nullptr) {
    EXPECT_EQ(read, set) << name;
  } else {
    EXPECT_NEAR(std::get<double>(read), *number, 2.0 * kEpsilon * std::abs(*number)) << name;
  }
}

TEST(Factors, EveryDefaultIsInsideItsRange) {
  for (const ParameterInfo& info : Factors().infos()) {
    EXPECT_EQ(info.Objection(info.default_value), std::nullopt) << info.name;
  }
}

TEST(Factors, WhatIsSetIsRead) {
  for (const ParameterInfo& info : Factors().infos()) {
    for (const ParameterValue& value : SomeValues(info)) {
      TrialSettings settings;
      Factors().Set(settings, info.name, value);
      ExpectSame(Factors().Get(settings, info.name), value, info.name);
    }
  }
}

TEST(Factors, EveryFactorHasAFieldOfItsOwn) {
  for (const ParameterInfo& changed : Factors().infos()) {
    TrialSettings settings;
    for (const ParameterValue& value : SomeValues(changed)) {
      Factors().Set(settings, changed.name, value);
      for (const ParameterInfo& other : Factors().infos()) {
        if (other.name == changed.name) continue;
        EXPECT_EQ(Factors().Get(settings, other.name), other.default_value)
            << changed.name << " changes " << other.name;
      }
    }
  }
}

TEST(Factors, AreFiniteDescribedAndNamedAfterTheirSensor) {
  for (const ParameterInfo& info : Factors().infos()) {
    EXPECT_TRUE(std::isfinite(info.min) || info.type == Type::kSwitch || info.type == Type::kChoice)
        << info.name;
    EXPECT_TRUE(info.description.ends_with(".")) << info.name;
    EXPECT_EQ(info.name.starts_with("stereo_"), GroupOf(info.name) == FactorGroup::kStereo);
    EXPECT_EQ(info.name.starts_with("rgbd_"), GroupOf(info.name) == FactorGroup::kRgbd);
  }
}

TEST(Factors, UnitsOfNamesBecomeSi) {
  TrialSettings settings;
  Factors().Set(settings, "azimuth_deg", 45.0);
  Factors().Set(settings, "stereo_exposure_ms", 2.0);
  Factors().Set(settings, "stereo_rotation_tolerance_mrad", 3.0);
  Factors().Set(settings, "stereo_pixel_pitch_um", 6.0);
  Factors().Set(settings, "ambient_830nm_ratio", 1.0);
  // One product each: half a unit in the last place.
  EXPECT_DOUBLE_EQ(settings.viewpoint.azimuth_rad, std::numbers::pi / 4.0);
  EXPECT_DOUBLE_EQ(settings.stereo.exposure.exposure_s, 2e-3);
  EXPECT_DOUBLE_EQ(settings.stereo.tolerances.rotation_rad, 3e-3);
  EXPECT_DOUBLE_EQ(settings.stereo.pixel_pitch_m, 6e-6);
  EXPECT_EQ(settings.lighting.irradiance_830_per_lux, kDaylightIrradiance830PerLux);
}

// Otherwise two factors would be drawn from the same numbers in every trial.
TEST(Factors, DrawFromDifferentStreams) {
  std::set<uint64_t> keys;
  for (const std::string& name : Factors().Names()) {
    EXPECT_TRUE(keys.insert(RandomStream(1).Child("factor:" + name).key()).second) << name;
  }
}

TEST(TrialSettings, DefaultsOfBothScenesAgree) {
  const PaperTargetOptions ours = PaperTargetOf(TrialSettings{});
  const PaperTargetOptions paper;
  EXPECT_EQ(ours.width_m, paper.width_m);
  EXPECT_EQ(ours.height_m, paper.height_m);
  EXPECT_EQ(ours.border_m, paper.border_m);
  EXPECT_EQ(ours.wall_width_m, paper.wall_width_m);
  EXPECT_EQ(ours.wall_height_m, paper.wall_height_m);
  EXPECT_EQ(ours.wall_reflectance, paper.wall_reflectance);
  EXPECT_EQ(ours.wall_reflectance_830nm, paper.wall_reflectance_830nm);
  EXPECT_EQ(ours.frame_reflectance, paper.frame_reflectance);
  EXPECT_EQ(ours.frame_reflectance_830nm, paper.frame_reflectance_830nm);
  EXPECT_EQ(ours.with_target, paper.with_target);
}

TEST(TrialSettings, WindowFactorsReachBothScenes) {
  TrialSettings settings;
  Factors().Set(settings, "window_width_m", 0.4);
  Factors().Set(settings, "window_height_m", 0.5);
  Factors().Set(settings, "frame_width_m", 0.05);
  for (const char* scene : {kPaperTargetScene, kFacadeScene}) {
    Factors().Set(settings, "scene", std::string(scene));
    Factors().Set(settings, "target", true);
    const Scene with = MakeScene(settings);
    ASSERT_TRUE(with.target) << scene;
    EXPECT_EQ(with.target->width_m, 0.4) << scene;
    EXPECT_EQ(with.target->height_m, 0.5) << scene;
    Factors().Set(settings, "target", false);
    EXPECT_FALSE(MakeScene(settings).target) << scene;
  }
}

}  // namespace
}  // namespace fenestra
