#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/study/factors.h"
#include "experiments/trial/scoring.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {
namespace {

// A facade with everything on it, in sizes and paints that a factor may change by a little.
TrialSettings EverythingOn() {
  TrialSettings settings;
  const auto set = [&settings](const std::string& name, const ParameterValue& value) {
    Factors().Set(settings, name, value);
  };
  set("scene", std::string(kFacadeScene));
  for (const ParameterInfo& info : Factors().infos()) {
    if (info.name.find("_reflectance") != std::string::npos) set(info.name, 0.3);
  }
  for (const char* name : {"sill", "lintel", "shutters", "drainpipe", "railing"}) set(name, true);
  for (const char* name : {"windows_left", "windows_right", "windows_above", "windows_below",
                           "vertical_mullions", "horizontal_mullions"}) {
    set(name, 1.0);
  }
  set("cables", 2.0);
  set("frame_setback_m", 0.1);
  set("window_gap_x_m", 1.3);
  set("drainpipe_x_m", 1.15);
  set("lintel_projection_m", 0.02);
  set("room_lamp_lm", 1000.0);
  set("other_room_lamps_lm", 500.0);
  set("room_lamp_830nm_ratio", 0.5);
  set("blind_coverage", 0.4);
  set("plant_coverage", 0.2);
  set("other_windows_share", 0.7);
  set("texture_contrast", 0.1);
  return settings;
}

ParameterValue ALittleElse(const ParameterInfo& info, const ParameterValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return !*flag;
  if (const std::string* word = std::get_if<std::string>(&value)) {
    return info.choices[*word == info.choices.front() ? 1 : 0];
  }
  const double number = std::get<double>(value);
  if (info.type == ParameterInfo::Type::kInteger) return number - 1.0;
  if (info.name == "other_windows_share") return 0.0;
  // These come in whole bars and whole leaves.
  if (info.name == "railing_bar_spacing_m" || info.name == "plant_coverage") return number * 1.3;
  return number * 1.01;
}

bool Same(const Material& a, const Material& b) {
  return a.name == b.name && a.kind == b.kind && a.reflectance_rgb == b.reflectance_rgb &&
         a.reflectance_830nm == b.reflectance_830nm && a.texture == b.texture;
}

bool Same(const Mesh& a, const Mesh& b) {
  return a.name == b.name && a.positions_W == b.positions_W && a.triangles == b.triangles &&
         a.texture_coordinates == b.texture_coordinates && a.colors == b.colors;
}

bool Same(const Scene& a, const Scene& b) {
  const auto same = [](const auto& x, const auto& y) { return Same(x, y); };
  return std::ranges::equal(a.meshes, b.meshes, same) &&
         std::ranges::equal(a.materials, b.materials, same) &&
         std::ranges::equal(
             a.textures, b.textures,
             [](const Texture& x, const Texture& y) { return x.texels == y.texels; }) &&
         std::ranges::equal(a.lamps, b.lamps, [](const Lamp& x, const Lamp& y) {
           return x.p_WL == y.p_WL && x.intensity_rgb == y.intensity_rgb &&
                  x.irradiance_830_per_lux == y.irradiance_830_per_lux;
         });
}

TEST(FacadeFactors, EachChangesTheScene) {
  const TrialSettings everything = EverythingOn();
  const Scene full = MakeScene(everything);
  EXPECT_TRUE(Same(full, MakeScene(everything)));
  for (const ParameterInfo& info : Factors().infos()) {
    if (GroupOf(info.name) != FactorGroup::kFacade) continue;
    TrialSettings changed = everything;
    Factors().Set(changed, info.name, ALittleElse(info, Factors().Get(changed, info.name)));
    EXPECT_FALSE(Same(full, MakeScene(changed))) << info.name;
  }
}

// An estimate at another window of the facade's grid is one of a wrong window.
TEST(FacadeFactors, OtherWindowsReachTruthAndScore) {
  TrialSettings settings;
  Factors().Set(settings, "scene", std::string(kFacadeScene));
  Factors().Set(settings, "windows_right", 1.0);
  Factors().Set(settings, "windows_above", 1.0);
  const Scene scene = MakeScene(settings);
  const CameraModel camera = CameraModel::Pinhole(640, 480, 400.0);
  const Eigen::Matrix3d R_WC = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  const Pose X_WC(R_WC, {0.0, 0.0, 4.0});
  const PlacedCamera placed{camera, X_WC};
  const GroundTruth truth = MakeGroundTruth(scene, X_WC, {&placed, 1});
  ASSERT_TRUE(truth.target && truth.in_view);
  ASSERT_EQ(truth.other_windows.size(), 3u);
  const auto outcome_at = [&truth](const WindowTruth& window) {
    WindowEstimate estimate;
    estimate.p_CO = window.p_CO;
    estimate.p_CV = window.p_CV;
    estimate.normal_C = window.normal_C;
    return ScoreDetection(Detection(estimate), truth).outcome;
  };
  EXPECT_EQ(outcome_at(*truth.target), Outcome::kHit);
  for (const WindowTruth& other : truth.other_windows) {
    EXPECT_EQ(outcome_at(other), Outcome::kWrongWindow);
  }
}

}  // namespace
}  // namespace fenestra
