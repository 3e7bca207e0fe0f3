#include "experiments/trial/calibrated_rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "experiments/study/factors.h"

namespace fenestra {
namespace {

StereoRigOptions SmallBoardImages() {
  StereoRigOptions options;
  options.width_px = 64;
  options.height_px = 48;
  options.focal_length_m = 4e-4;  // The same view, in a tenth of the pixels' number along a side.
  return options;
}

TEST(BoardCalibrationTest, BoardsTellTheRigToWhatTheirCovarianceSays) {
  const StereoRig rig({}, RandomStream(1));
  BoardSessionOptions session;
  session.views = 8;
  session.tolerances = kAsDrawn;
  const StereoCalibrationResult result = CalibrateWithBoards(rig, session, {}, RandomStream(3));
  EXPECT_TRUE(result.left_out.empty());
  const PairVector error = PairError(result.calibration, rig.cameras());
  for (int i = 0; i < kPairParameters; ++i) {
    const double sigma = std::sqrt(result.covariance(i, i));
    // Normal: 5 of them are exceeded once in 10⁵ by any of 22 parameters; fixed ones do not err.
    EXPECT_LE(std::abs(error[i]), 5.0 * sigma) << PairParameterNames()[static_cast<size_t>(i)];
  }
  // A covariance ten times too large would pass above. The pixels alone say how good it has to be:
  // corners to 0.01 px, some 400 of them, leave a focal length of 667 px to well below one.
  EXPECT_LT(std::sqrt(result.covariance(0, 0)), 1.0);
  EXPECT_LT(result.rms_px, 0.1);
  // The twin: the rig as designed is no calibration.
  const PairVector design = PairError(DesignOf(rig.options()), rig.cameras());
  const PairVector deviation = result.covariance.diagonal().cwiseSqrt();
  EXPECT_GT(design.cwiseAbs()[0], 5.0 * deviation[0]);
}

// Recorded: residuals of 0.074 to 0.13 px a coordinate, and focal lengths whose stated deviations
// are two to three times too small where sets of one board are compared; a board's own errors,
// which all of its pictures share, come to that.
TEST(BoardCalibrationTest, ACalibrationWithABoardAsMadeLooksLikeARecordedOne) {
  constexpr int kSets = 2;
  BoardSessionOptions session;
  session.views = 8;
  double square_px2 = 0.0;
  double focal = 0.0;
  for (uint64_t set = 0; set < kSets; ++set) {
    const StereoRig rig({}, RandomStream(set));
    const StereoCalibrationResult result =
        CalibrateWithBoards(rig, session, {.free_k3 = true}, RandomStream(set).Child("boards"));
    square_px2 += result.corner_deviation_px * result.corner_deviation_px / kSets;
    const PairVector error = PairError(result.calibration, rig.cameras());
    for (const int camera : {0, kCameraParameters}) {
      focal += error[camera] * error[camera] / result.covariance(camera, camera);
    }
  }
  // With 15 lines and a bow to each board, means over two boards scatter by a quarter.
  EXPECT_GT(std::sqrt(square_px2), 0.05) << std::sqrt(square_px2);
  EXPECT_LT(std::sqrt(square_px2), 0.15) << std::sqrt(square_px2);
  // Of an honest deviation at most the sum of four squares, here of two pairs of nearly equal
  // errors: 30 is exceeded once in 10⁵.
  EXPECT_GT(focal, 30.0);
}

// The same factor with another value that is allowed.
ParameterValue OtherValue(const ParameterInfo& info, const ParameterValue& value) {
  if (const bool* on = std::get_if<bool>(&value)) return !*on;
  if (const auto* word = std::get_if<std::string>(&value)) {
    return info.choices.front() == *word ? info.choices.back() : info.choices.front();
  }
  const double number = std::get<double>(value);
  const double step = info.type == ParameterInfo::Type::kInteger ? 1.0 : 0.01 * std::abs(number);
  for (const double other : {number + step, number - step, info.max, info.min}) {
    if (other != number && other >= info.min && other <= info.max) return other;
  }
  return value;
}

std::string ContentOf(const TrialSettings& settings) {
  return ContentOf(StereoRig(settings.stereo, RandomStream(1)), settings.stereo_calibration,
                   RandomStream(2));
}

TEST(BoardCalibrationTest, EveryFactorOfRigAndBoardsIsInTheContent) {
  // The boards are photographed standing still, before the rig is shaken, and whoever it is told.
  const std::set<std::string> without_effect = {"stereo_rig_per_trial",
                                                "stereo_calibration",
                                                "stereo_shake_rotation_mrad",
                                                "stereo_shake_translation_mm",
                                                "stereo_calibration_rotation_error_mrad",
                                                "stereo_calibration_translation_error_mm",
                                                "stereo_calibration_corner_noise_px",
                                                "stereo_speed_right_m_s",
                                                "stereo_speed_down_m_s",
                                                "stereo_speed_forward_m_s",
                                                "stereo_pitch_rate_deg_s",
                                                "stereo_yaw_rate_deg_s",
                                                "stereo_roll_rate_deg_s",
                                                "stereo_hover_speed_m_s",
                                                "stereo_hover_turn_deg_s",
                                                "stereo_trigger_skew_us"};
  TrialSettings settings;
  settings.stereo = SmallBoardImages();
  std::map<std::string, std::string> factor_of_content = {{ContentOf(settings), "none"}};
  for (const ParameterInfo& info : Factors().infos()) {
    if (GroupOf(info.name) != FactorGroup::kStereo) continue;
    TrialSettings other = settings;
    const ParameterValue before = Factors().Get(settings, info.name);
    Factors().Set(other, info.name, OtherValue(info, before));
    ASSERT_NE(Factors().Get(other, info.name), before) << info.name;
    const auto [same, is_new] = factor_of_content.emplace(ContentOf(other), info.name);
    EXPECT_EQ(is_new, !without_effect.contains(info.name)) << info.name << ", " << same->second;
  }
}

TEST(BoardCalibrationTest, EachRigAndEachSessionHasItsOwnContent) {
  const StereoRig rig(SmallBoardImages(), RandomStream(1));
  const RandomStream stream(2);
  const std::string content = ContentOf(rig, {}, stream);
  EXPECT_EQ(content, ContentOf(StereoRig(SmallBoardImages(), RandomStream(1)), {}, stream));
  EXPECT_NE(content, ContentOf(StereoRig(SmallBoardImages(), RandomStream(7)), {}, stream));
  EXPECT_NE(content, ContentOf(rig, {}, RandomStream(3)));
  EXPECT_NE(content, ContentOf(rig.Displaced(Pose::Translation({1e-4, 0.0, 0.0})), {}, stream));
}

TEST(BoardCalibrationTest, TrialsThatDifferInTheSceneAloneShareACalibration) {
  TrialSettings settings;
  settings.stereo = SmallBoardImages();
  for (const ParameterInfo& info : Factors().infos()) {
    if (GroupOf(info.name) == FactorGroup::kStereo) continue;
    TrialSettings other = settings;
    Factors().Set(other, info.name, OtherValue(info, Factors().Get(settings, info.name)));
    EXPECT_EQ(ContentOf(other), ContentOf(settings)) << info.name;
  }
}

TEST(BoardCalibrationTest, ARigThatMovesIsCalibratedStandingStill) {
  StereoRigOptions moving = SmallBoardImages();
  moving.motion.velocity_B = {5.0, 1.0, -2.0};
  moving.motion.angular_velocity_B = {1.0, 2.0, 3.0};
  moving.trigger_skew_s = 1e-3;
  const BoardSessionOptions session;
  const BoardWorld world{BoardShape(session.board, kAsDrawn, RandomStream(0))};
  const auto left = [&](const StereoRigOptions& options) {
    return ShootBoard(StereoRig(options, RandomStream(1)), world, session, RandomStream(2)).left;
  };
  EXPECT_EQ(cv::norm(left(moving), left(SmallBoardImages())), 0.0);
}

}  // namespace
}  // namespace fenestra
