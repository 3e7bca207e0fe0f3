#include "vision/stereo/paper/paper_stereo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/io/input_error.h"
#include "tests/vision/stereo/stereo_scene.h"

namespace fenestra {
namespace {

using testing::PaperRig;
using testing::Photo;
using testing::Photograph;
using testing::View;
using testing::WindowSeenFrom;

constexpr Photo kNoisy{.noise_dn = 2.0};

Detection Detect(const StereoCalibration& rig, const StereoObservation& observation,
                 const PaperStereoOptions& options = {}) {
  StageLog log(SteadyClock());
  return PaperStereoDetector(rig, options).Detect(observation, log);
}

std::string Describe(const Detection& detection) {
  const Miss* miss = std::get_if<Miss>(&detection);
  return miss == nullptr ? "found" : miss->reason + ": " + miss->detail;
}

// Errors that are to be expected of a centroid at distance z:
//   depth      0.25 px of disparity: 1/16 px steps and the bias of a parabola through SAD sums;
//   laterally  2.5 px: bands end where noise lets them, some pixels late or early at each end.
void ExpectCentroid(const Detection& detection, const Pose& X_LO, double baseline_m = 0.35) {
  const auto* estimate = std::get_if<WindowEstimate>(&detection);
  ASSERT_NE(estimate, nullptr) << Describe(detection);
  const double f_px = 600.0;  // Of the smaller rectified image of a distorted lens.
  const Eigen::Vector3d error = estimate->p_CO - X_LO.translation();
  const double z = X_LO.translation().z();
  EXPECT_LT(std::abs(error.z()), 0.25 * z * z / (f_px * baseline_m));
  EXPECT_LT(error.head<2>().norm(), 2.5 * z / f_px);
}

struct Case {
  View view;
  bool real_rig;  ///< Lenses with distortion, the right camera turned by about a degree.
};

class PaperStereoFinds : public ::testing::TestWithParam<Case> {};

TEST_P(PaperStereoFinds, ANoisyFrame) {
  const StereoCalibration rig = GetParam().real_rig
                                    ? PaperRig({.k1 = -0.1, .k2 = 0.01}, {0.009, 0.0175, -0.012})
                                    : PaperRig();
  const Pose X_LO = WindowSeenFrom(GetParam().view);
  ExpectCentroid(Detect(rig, Photograph(rig, X_LO, {}, kNoisy, RandomStream(11))), X_LO);
}

INSTANTIATE_TEST_SUITE_P(
    Views, PaperStereoFinds,
    ::testing::Values(Case{{.distance_m = 1.4}, false}, Case{{.distance_m = 2.0}, true},
                      Case{{.distance_m = 2.0, .azimuth_deg = 20.0}, false},
                      Case{{.distance_m = 3.0, .azimuth_deg = -20.0, .roll_deg = 5.0}, false},
                      Case{{.distance_m = 4.0, .yaw_deg = 5.0, .roll_deg = -5.0}, false},
                      Case{{.distance_m = 6.0, .yaw_deg = -5.0, .pitch_deg = 5.0}, true},
                      Case{{.distance_m = 8.0, .azimuth_deg = 15.0}, false},
                      Case{{.distance_m = 10.0}, false},
                      Case{{.distance_m = 10.0, .roll_deg = 5.0}, true}));

TEST(PaperStereo, EstimateIsARectangleThatFacesTheCamera) {
  const StereoCalibration rig = PaperRig();
  const Pose X_LO = WindowSeenFrom({.distance_m = 2.5, .azimuth_deg = 15.0});
  const Detection detection = Detect(rig, Photograph(rig, X_LO, {}, {}, RandomStream(1)));
  const auto* estimate = std::get_if<WindowEstimate>(&detection);
  ASSERT_NE(estimate, nullptr) << Describe(detection);
  EXPECT_GT(estimate->normal_C.dot(X_LO.rotation().col(2)), std::cos(0.01));
  const double pixel_m = 2.5 / 667.0;
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p_OV(i == 1 || i == 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5, 0.0);
    // Where a band ends is known to a fraction of the window's half: 3 of 7 px.
    EXPECT_LT((estimate->p_CV[i] - X_LO * p_OV).norm(), 3.0 * std::sqrt(2.0) * pixel_m) << i;
  }
}

TEST(PaperStereo, ScalingTheWorldScalesTheEstimate) {
  const StereoCalibration rig = PaperRig();
  const StereoCalibration big_rig = PaperRig({}, Eigen::Vector3d::Zero(), 3.0 * 0.35);
  const StereoObservation observation = Photograph(
      rig, WindowSeenFrom({.distance_m = 3.0, .yaw_deg = 3.0}), {}, kNoisy, RandomStream(2));
  PaperStereoOptions big;
  big.nearest_m *= 3.0;
  big.farthest_m *= 3.0;
  big.min_side_m *= 3.0;
  big.max_side_m *= 3.0;
  const Detection one = Detect(rig, observation);
  const Detection three = Detect(big_rig, observation, big);
  ASSERT_TRUE(std::holds_alternative<WindowEstimate>(one)) << Describe(one);
  ASSERT_TRUE(std::holds_alternative<WindowEstimate>(three)) << Describe(three);
  // The same pixels in another unit of length: equal but for rounding.
  EXPECT_LT(
      (3.0 * std::get<WindowEstimate>(one).p_CO - std::get<WindowEstimate>(three).p_CO).norm(),
      1e-6);
}

TEST(PaperStereo, MirroredImagesMirrorTheEstimate) {
  const StereoCalibration rig = PaperRig();
  for (const View& view :
       {View{.distance_m = 3.0, .azimuth_deg = 12.0, .roll_deg = 2.0},
        View{.distance_m = 2.0, .azimuth_deg = -8.0}, View{.distance_m = 5.0, .yaw_deg = 4.0}}) {
    const auto seen = Photograph(rig, WindowSeenFrom(view), {}, kNoisy, RandomStream(1));
    StereoObservation mirrored;
    cv::flip(seen.right, mirrored.left, 1);
    cv::flip(seen.left, mirrored.right, 1);
    const Detection detection = Detect(rig, seen);
    const auto* one = std::get_if<WindowEstimate>(&detection);
    ASSERT_NE(one, nullptr) << Describe(detection);
    // x -> B - x, as the mirrored right camera becomes the left one. Blocks of the other image are
    // searched for now: not the same estimate, but one with the same errors.
    ExpectCentroid(Detect(rig, mirrored),
                   Pose::Translation({0.35 - one->p_CO.x(), one->p_CO.y(), one->p_CO.z()}));
    // The twin with a fault: the images are mirrored, but not exchanged.
    std::swap(mirrored.left, mirrored.right);
    EXPECT_TRUE(std::holds_alternative<Miss>(Detect(rig, mirrored))) << view.distance_m;
  }
}

TEST(PaperStereo, BrightnessDoesNotMatter) {
  const StereoCalibration rig = PaperRig();
  const Pose X_LO = WindowSeenFrom({.distance_m = 4.0});
  for (const Photo& photo : {Photo{.wall_dn = 240.0, .frame_dn = 90.0, .noise_dn = 2.0},
                             Photo{.wall_dn = 110.0, .frame_dn = 8.0, .noise_dn = 2.0}}) {
    ExpectCentroid(Detect(rig, Photograph(rig, X_LO, {}, photo, RandomStream(4))), X_LO);
  }
}

TEST(PaperStereo, TwiceTheLightChangesNothingButTheNoise) {
  const StereoCalibration rig = PaperRig();
  const Pose X_LO = WindowSeenFrom({.distance_m = 4.0, .azimuth_deg = 8.0});
  const Photo dim{.wall_dn = 110.0, .frame_dn = 10.0, .noise_dn = 1.0};
  const StereoObservation seen = Photograph(rig, X_LO, {}, dim, RandomStream(4));
  const StereoObservation twice{2.0 * seen.left, 2.0 * seen.right};
  ExpectCentroid(Detect(rig, seen), X_LO);
  ExpectCentroid(Detect(rig, twice), X_LO);
}

TEST(PaperStereo, SeveralWindowsAreReportedTheBestFirst) {
  const StereoCalibration rig = PaperRig();
  // Two frames, one in the left half of both images, one in the right.
  StereoObservation seen = Photograph(rig, WindowSeenFrom({.distance_m = 5.0, .yaw_deg = 16.0}), {},
                                      kNoisy, RandomStream(3));
  const StereoObservation other = Photograph(
      rig, WindowSeenFrom({.distance_m = 5.0, .yaw_deg = -16.0}), {}, kNoisy, RandomStream(4));
  seen.left = cv::Mat1b(cv::min(cv::Mat(seen.left), cv::Mat(other.left)));
  seen.right = cv::Mat1b(cv::min(cv::Mat(seen.right), cv::Mat(other.right)));
  PaperStereoOptions options;  // Without a size, what is between the two would be a window, too.
  options.prior.expected_width_m = options.prior.expected_height_m = 1.0;
  const Detection detection = Detect(rig, seen, options);
  const auto* best = std::get_if<WindowEstimate>(&detection);
  ASSERT_NE(best, nullptr) << Describe(detection);
  ASSERT_EQ(best->others.size(), 1u);
  ASSERT_TRUE(best->score && best->others[0].score);
  EXPECT_GE(*best->score, *best->others[0].score);
  EXPECT_GT(*best->others[0].score, 0.3);
  EXPECT_LE(*best->score, 1.0);
  // 16° to either side of straight ahead: 2 · 5 m · sin 16°.
  EXPECT_NEAR((best->p_CO - best->others[0].p_CO).norm(), 2.76, 0.1);
  options.most_windows = 1;
  const Detection alone = Detect(rig, seen, options);
  EXPECT_TRUE(std::get<WindowEstimate>(alone).others.empty());
}

TEST(PaperStereo, APriorRefusesOtherSizesAndGreys) {
  const StereoCalibration rig = PaperRig();
  const auto seen = Photograph(rig, WindowSeenFrom({}), {}, kNoisy, RandomStream(5));
  const auto reason = [&](const PaperStereoOptions& options) {
    const Detection detection = Detect(rig, seen, options);
    const Miss* miss = std::get_if<Miss>(&detection);
    return miss == nullptr ? "found" : miss->reason;
  };
  PaperStereoOptions options;
  options.prior.expected_width_m = options.prior.expected_height_m = 1.0;
  options.prior.expected_shape = ExpectedShape::kUprightRectangle;
  options.prior.expected_grey_ratio = 0.03;  // (12 - 8) / (165 - 8).
  EXPECT_EQ(reason(options), "found");
  options.prior.expected_grey_ratio = 0.6;
  EXPECT_EQ(reason(options), "unexpected_grey");
  options.prior.expected_width_m = 2.0;
  EXPECT_EQ(reason(options), "unexpected_size");
}

TEST(PaperStereo, SwappedImagesAreAMiss) {
  const StereoCalibration rig = PaperRig();
  for (const double distance_m : {2.0, 3.0, 5.0, 8.0}) {
    const Pose X_LO = WindowSeenFrom({.distance_m = distance_m});
    StereoObservation seen = Photograph(rig, X_LO, {}, kNoisy, RandomStream(6));
    ExpectCentroid(Detect(rig, seen), X_LO);  // The twin without the fault.
    std::swap(seen.left, seen.right);
    EXPECT_TRUE(std::holds_alternative<Miss>(Detect(rig, seen))) << distance_m;
  }
}

TEST(PaperStereo, SeesNoWindowWhereThereIsNone) {
  const StereoCalibration rig = PaperRig();
  for (const double grey : {0.0, 128.0, 255.0}) {
    const cv::Mat1b flat(480, 752, static_cast<uint8_t>(grey));
    const Detection detection = Detect(rig, {flat, flat});
    ASSERT_TRUE(std::holds_alternative<Miss>(detection)) << grey;
    EXPECT_EQ(std::get<Miss>(detection).reason, "no_matches");
  }
  const testing::PlanarTarget speck{.outer_side_m = 1e-6, .border_m = 0.0};
  for (const double noise_dn : {2.0, 60.0}) {
    const Photo photo{.wall_dn = 128.0, .noise_dn = noise_dn};
    const auto seen = Photograph(rig, WindowSeenFrom({}), speck, photo, RandomStream(8));
    EXPECT_TRUE(std::holds_alternative<Miss>(Detect(rig, seen))) << noise_dn;
    // One image seen twice from 5 m: a textured wall, matched everywhere.
    StereoObservation wall{cv::Mat1b(480, 752), cv::Mat1b(480, 752)};
    const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, -47, 0, 1, 0);
    wall.left = seen.left;
    cv::warpAffine(seen.left, wall.right, shift, {752, 480}, cv::INTER_NEAREST, cv::BORDER_REFLECT);
    const Detection textured = Detect(rig, wall);
    EXPECT_TRUE(std::holds_alternative<Miss>(textured)) << noise_dn;
  }
}

TEST(PaperStereo, OtherSensorsAndSizesAreInputErrors) {
  const PaperStereoDetector detector(PaperRig(), {});
  StageLog log(SteadyClock());
  EXPECT_EQ(detector.sensor(), SensorKind::kStereo);
  EXPECT_THROW(detector.Detect(RgbdObservation{}, log), InputError);
  EXPECT_THROW(detector.Detect(StereoObservation{}, log), InputError);
  const cv::Mat1b tiny(1, 1, uint8_t{7});
  EXPECT_THROW(detector.Detect(StereoObservation{tiny, tiny}, log), InputError);
}

TEST(PaperStereo, SmallImagesAreMissedNotFatal) {
  for (const auto& [width, height] : {std::pair{16, 16}, {752, 16}, {16, 480}, {97, 61}}) {
    const CameraModel camera = CameraModel::Pinhole(width, height, 50.0);
    const StereoCalibration rig{camera, camera, Pose::Translation({-0.35, 0.0, 0.0})};
    cv::Mat1f noise(height, width);
    RandomStream(10).FillUniforms({noise.ptr<float>(), noise.total()});
    const cv::Mat1b left = 255.0 * noise;
    EXPECT_TRUE(std::holds_alternative<Miss>(Detect(rig, {left, left}))) << width << ' ' << height;
  }
}

TEST(PaperStereo, StagesComeInThePapersOrderAndPicturesOnRequest) {
  const StereoCalibration rig = PaperRig();
  const auto seen = Photograph(rig, WindowSeenFrom({}), {}, kNoisy, RandomStream(9));
  const PaperStereoDetector detector(rig, {});
  StageLog log(SteadyClock(), /*keep_artifacts=*/true);
  const Detection first = detector.Detect(seen, log);
  std::vector<std::string> stages;
  for (const StageTime& time : log.times()) stages.push_back(time.stage);
  EXPECT_THAT(stages, ::testing::ElementsAre("rectify", "match", "depth_image", "close_gaps",
                                             "edges", "contour", "centroid"));
  std::vector<std::string> pictures;
  for (const StagePicture& picture : log.pictures()) {
    pictures.push_back(picture.name);
    EXPECT_EQ(picture.image.depth(), CV_8U);
  }
  EXPECT_THAT(pictures,
              ::testing::ElementsAre("rectified", "depth_image", "closed_contour", "edges"));
  // It remembers nothing: the second time gives the same bits.
  StageLog silent(SteadyClock());
  const Detection second = detector.Detect(seen, silent);
  EXPECT_TRUE(silent.pictures().empty());
  EXPECT_EQ(std::get<WindowEstimate>(first).p_CO, std::get<WindowEstimate>(second).p_CO);
}

TEST(PaperStereoOptionsTest, ValidateNamesAllFaultsAtOnce) {
  EXPECT_NO_THROW(Validate(PaperStereoOptions{}));
  PaperStereoOptions bad;
  bad.sad_window_px = 14;
  bad.nearest_m = 20.0;
  bad.uniqueness_percent = -1;
  try {
    Validate(bad);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3u) << error.what();
  }
}

}  // namespace
}  // namespace fenestra
