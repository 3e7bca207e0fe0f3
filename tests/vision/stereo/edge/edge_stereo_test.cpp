#include "vision/stereo/edge/edge_stereo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <boost/math/distributions/chi_squared.hpp>
#include <opencv2/imgproc.hpp>

#include "core/io/input_error.h"
#include "tests/vision/frame/exact_frame.h"
#include "tests/vision/stereo/exact_bound.h"
#include "tests/vision/stereo/stereo_scene.h"

namespace fenestra {
namespace {

using testing::ExactBound;
using testing::ExactFrame;
using testing::ExactPair;
using testing::ExactPicture;
using testing::OptionsForExactPictures;
using testing::PaperRig;
using testing::Photo;
using testing::Photograph;
using testing::View;
using testing::WindowSeenFrom;

constexpr double kBaseline_m = 0.35;
constexpr double kNoise_dn = 2.0;

Detection Detect(const StereoCalibration& rig, const StereoObservation& observation,
                 const EdgeStereoOptions& options = OptionsForExactPictures()) {
  StageLog log(SteadyClock());
  return EdgeStereoDetector(rig, options).Detect(observation, log);
}

std::string Describe(const Detection& detection) {
  const Miss* miss = std::get_if<Miss>(&detection);
  return miss == nullptr ? "found" : miss->reason + ": " + miss->detail;
}

WindowEstimate Found(const Detection& detection) {
  EXPECT_TRUE(std::holds_alternative<WindowEstimate>(detection)) << Describe(detection);
  const auto* estimate = std::get_if<WindowEstimate>(&detection);
  return estimate == nullptr ? WindowEstimate{} : *estimate;
}

ExactFrame FrameSeenFrom(const View& view) {
  return {.X_LO = WindowSeenFrom(view)};
}

// Half the images' size, for tests with many pictures.
StereoCalibration SmallRig() {
  const CameraModel camera = CameraModel::Pinhole(376, 240, 333.0);
  return {camera, camera, Pose::Translation({-kBaseline_m, 0.0, 0.0})};
}

class EdgeStereoRecovers : public ::testing::TestWithParam<View> {};

TEST_P(EdgeStereoRecovers, TheCornersOfAnExactPicture) {
  const StereoCalibration rig = PaperRig({}, {0.009, 0.0175, -0.012});
  const ExactFrame frame = FrameSeenFrom(GetParam());
  const WindowEstimate estimate = Found(Detect(rig, ExactPair(rig, frame, 0.0, RandomStream(1))));
  const double z = frame.X_LO.translation().z();
  const double f_px = 667.0;
  // Rounding to 8 bits moves an edge of 150 DN by some thousandths of a pixel at each place. Where
  // an edge is nearly along the pixels' rows that is the same at many places: 0.01 px is left.
  const double edge_px = 0.01;
  const double lateral_m = edge_px * z / f_px;
  const double depth_m = 2.0 * edge_px * z * z / (f_px * kBaseline_m);
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p_OV(i == 1 || i == 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5, 0.0);
    EXPECT_LT((estimate.p_CV[i] - frame.X_LO * p_OV).norm(), lateral_m + depth_m) << i;
  }
  EXPECT_LT((estimate.p_CO - frame.X_LO.translation()).norm(), lateral_m + 0.5 * depth_m);
  EXPECT_GT(estimate.normal_C.dot(frame.X_LO.rotation().col(2)), std::cos(0.01));
}

INSTANTIATE_TEST_SUITE_P(
    Views, EdgeStereoRecovers,
    ::testing::Values(View{.distance_m = 2.0, .azimuth_deg = 3.0}, View{.distance_m = 3.0},
                      View{.distance_m = 3.0, .azimuth_deg = -30.0, .roll_deg = 5.0},
                      View{.distance_m = 4.0, .azimuth_deg = 50.0, .pitch_deg = 3.0},
                      View{.distance_m = 6.0, .yaw_deg = -5.0, .pitch_deg = 5.0, .roll_deg = 15.0},
                      View{.distance_m = 8.0, .azimuth_deg = 40.0},
                      View{.distance_m = 10.0, .azimuth_deg = 10.0, .roll_deg = -3.0}));

TEST(EdgeStereo, DistortedAndTurnedCamerasAreNoTrouble) {
  const StereoCalibration rig = PaperRig({.k1 = -0.1, .k2 = 0.01}, {0.009, 0.0175, -0.012});
  const Pose X_LO = WindowSeenFrom({.distance_m = 2.0, .azimuth_deg = 10.0, .roll_deg = 3.0});
  const WindowEstimate estimate =
      Found(Detect(rig, Photograph(rig, X_LO, {}, {.noise_dn = kNoise_dn}, RandomStream(11))));
  // That picture's edges are right to a sixteenth of a pixel (see stereo_scene.cpp), which averages
  // out along edges that are not parallel to the pixels: 0.03 px of disparity are left.
  EXPECT_LT((estimate.p_CO - X_LO.translation()).norm(), 0.03 * 4.0 / (600.0 * kBaseline_m));
}

TEST(EdgeStereo, ScalingTheWorldScalesTheEstimate) {
  const StereoCalibration rig = PaperRig();
  const StereoCalibration big_rig = PaperRig({}, Eigen::Vector3d::Zero(), 3.0 * kBaseline_m);
  const StereoObservation seen = ExactPair(rig, FrameSeenFrom({.distance_m = 3.0, .yaw_deg = 3.0}),
                                           kNoise_dn, RandomStream(2));
  EdgeStereoOptions big = OptionsForExactPictures();
  for (double* length :
       {&big.search.limits.nearest_m, &big.search.limits.farthest_m, &big.search.limits.min_side_m,
        &big.search.limits.max_side_m, &big.search.min_border_m}) {
    *length *= 3.0;
  }
  const WindowEstimate one = Found(Detect(rig, seen));
  const WindowEstimate three = Found(Detect(big_rig, seen, big));
  // The same pixels in another unit of length. Rounds end when a step is below 3e-4 standard
  // deviations, which is 1e-7 m here.
  EXPECT_LT((3.0 * one.p_CO - three.p_CO).norm(), 1e-5);
  EXPECT_LT((9.0 * *one.covariance_C - *three.covariance_C).norm(),
            1e-3 * three.covariance_C->norm());
  // The twin with a fault: a baseline that is a thousandth too long.
  const StereoCalibration longer = PaperRig({}, Eigen::Vector3d::Zero(), 3.003 * kBaseline_m);
  EXPECT_GT((3.0 * one.p_CO - Found(Detect(longer, seen, big)).p_CO).norm(), 1e-3);
}

TEST(EdgeStereo, TwiceTheLightChangesNothingButTheNoise) {
  const StereoCalibration rig = PaperRig();
  ExactFrame frame = FrameSeenFrom({.distance_m = 4.0, .azimuth_deg = 20.0});
  frame.wall_dn = frame.opening_dn = 100.0;
  const WindowEstimate dim = Found(Detect(rig, ExactPair(rig, frame, kNoise_dn, RandomStream(4))));
  frame.wall_dn = frame.opening_dn = 200.0;
  frame.frame_dn *= 2.0;
  const WindowEstimate bright =
      Found(Detect(rig, ExactPair(rig, frame, kNoise_dn, RandomStream(5))));
  const Eigen::Vector3d difference = dim.p_CO - bright.p_CO;
  const Eigen::Matrix3d covariance = *dim.covariance_C + *bright.covariance_C;
  // χ² of 3 degrees of freedom, 1e-3.
  EXPECT_LT(difference.dot(covariance.inverse() * difference), 16.27);
  // The twin with a fault: a frame that has moved by 2 mm meanwhile.
  const Eigen::Vector3d moved = difference + Eigen::Vector3d(0.002, 0.0, 0.0);
  EXPECT_GT(moved.dot(covariance.inverse() * moved), 16.27);
  // Twice the contrast at the same noise: half the standard deviation.
  EXPECT_NEAR(std::sqrt(dim.covariance_C->trace() / bright.covariance_C->trace()), 2.0, 0.3);
}

// Sum over trials of the centroid's squared error in units of `scale` times its covariance, and the
// mean of the covariances and squared errors.
struct Trials {
  int count = 0;
  double normalised_square = 0.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
};

// The picture in one of the lights that the detector allows for: slopes of the wall's grey values
// are what vignetting makes of them give or take 0.02 % a pixel
// (vision/frame/measurement/edge_nuisance.cpp).
cv::Mat1f InSomeLight(const cv::Mat1f& picture, const CameraView& view, const ExactFrame& frame,
                      const RandomStream& stream) {
  std::array<double, 4> slopes_per_px;
  for (size_t side = 0; side < 4; ++side) slopes_per_px[side] = 0.0002 * stream.Normal(side);
  return testing::WithUnevenLight(picture, view.camera, view.X_CL, frame, slopes_per_px);
}

Trials Try(const View& view, int count) {
  const StereoCalibration rig = SmallRig();
  const ExactFrame frame = FrameSeenFrom(view);
  const cv::Mat1f left = ExactPicture(rig.left, Pose(), frame);
  const cv::Mat1f right = ExactPicture(rig.right, rig.X_RL, frame);
  Trials trials;
  for (int i = 0; i < count; ++i) {
    const auto stream = RandomStream(7).Child("trial", static_cast<uint64_t>(i));
    const auto seen = testing::WithNoise(
        InSomeLight(left, {rig.left, Pose(), {}}, frame, stream.Child("left_light")),
        InSomeLight(right, {rig.right, rig.X_RL, {}}, frame, stream.Child("right_light")),
        kNoise_dn, stream);
    const WindowEstimate estimate = Found(Detect(rig, seen));
    if (!estimate.covariance_C) return trials;
    const Eigen::Vector3d error = estimate.p_CO - frame.X_LO.translation();
    trials.normalised_square += error.dot(estimate.covariance_C->inverse() * error);
    trials.covariance += *estimate.covariance_C / count;
    trials.square += error * error.transpose() / count;
    ++trials.count;
  }
  return trials;
}

// Two-sided 1 % test of the mean normalised squared error, 3 degrees of freedom each.
bool IsHonest(double normalised_square, int count) {
  const boost::math::chi_squared distribution(3.0 * count);
  return normalised_square > quantile(distribution, 0.005) &&
         normalised_square < quantile(distribution, 0.995);
}

const std::array<View, 3> kCovarianceViews = {
    View{.distance_m = 2.5, .azimuth_deg = 7.0, .roll_deg = 4.0},
    View{.distance_m = 3.5, .azimuth_deg = -35.0, .roll_deg = 2.0},
    View{.distance_m = 4.5, .azimuth_deg = 10.0, .pitch_deg = 2.0, .roll_deg = 8.0}};

TEST(EdgeStereo, CovarianceIsHonest) {
  double sum = 0.0;
  int count = 0;
  for (const View& view : kCovarianceViews) {
    const Trials trials = Try(view, 80);
    sum += trials.normalised_square;
    count += trials.count;
  }
  ASSERT_EQ(count, 240);
  EXPECT_TRUE(IsHonest(sum, count)) << sum / count << " of 3 in the mean";
  // The twin with a fault: a covariance of half the size, or twice.
  EXPECT_FALSE(IsHonest(2.0 * sum, count));
  EXPECT_FALSE(IsHonest(0.5 * sum, count));
}

TEST(EdgeStereo, ErrorIsNearTheCramerRaoBound) {
  for (const View& view : kCovarianceViews) {
    const Eigen::Matrix3d bound =
        ExactBound(SmallRig(), FrameSeenFrom(view), kNoise_dn * kNoise_dn + 1.0 / 12.0);
    const Trials trials = Try(view, 60);
    ASSERT_EQ(trials.count, 60);
    for (int axis = 0; axis < 3; ++axis) {
      const double ratio = std::sqrt(trials.square(axis, axis) / bound(axis, axis));
      // The root mean square of 60 has a standard deviation of 1/√120: 9 %, so 0.75 and less
      // would be too good.
      EXPECT_GT(ratio, 0.75) << view.distance_m << " m, axis " << axis;
      EXPECT_LT(ratio, 1.5) << view.distance_m << " m, axis " << axis;
    }
  }
}

TEST(EdgeStereo, KnownSizeHelpsAndAWrongOneFindsNothing) {
  const StereoCalibration rig = PaperRig();
  const ExactFrame frame = FrameSeenFrom({.distance_m = 8.0, .azimuth_deg = 10.0});
  const StereoObservation seen = ExactPair(rig, frame, kNoise_dn, RandomStream(3));
  EdgeStereoOptions options = OptionsForExactPictures();
  options.prior.expected_width_m = options.prior.expected_height_m = 1.0;
  options.prior.expected_size_sigma_m = 1e-5;
  const WindowEstimate free = Found(Detect(rig, seen));
  const WindowEstimate known = Found(Detect(rig, seen, options));
  EXPECT_LT((*known.covariance_C)(2, 2), (*free.covariance_C)(2, 2));
  const Eigen::Vector3d error = known.p_CO - frame.X_LO.translation();
  EXPECT_LT(error.dot(known.covariance_C->inverse() * error), 16.27);  // χ² of 3, 1e-3.
  options.prior.expected_width_m = 1.4;
  const Detection wrong = Detect(rig, seen, options);
  ASSERT_TRUE(std::holds_alternative<Miss>(wrong));
  EXPECT_EQ(std::get<Miss>(wrong).reason, "unexpected_size");
}

TEST(EdgeStereo, SwappedImagesAreAMiss) {
  const StereoCalibration rig = PaperRig();
  for (const double distance_m : {2.0, 3.0, 5.0, 8.0}) {
    StereoObservation seen =
        ExactPair(rig, FrameSeenFrom({.distance_m = distance_m}), kNoise_dn, RandomStream(6));
    Found(Detect(rig, seen));  // The twin without the fault.
    std::swap(seen.left, seen.right);
    EXPECT_TRUE(std::holds_alternative<Miss>(Detect(rig, seen))) << distance_m;
  }
}

TEST(EdgeStereo, SeesNoWindowWhereThereIsNone) {
  const StereoCalibration rig = PaperRig();
  for (const double grey : {0.0, 128.0, 255.0}) {
    const cv::Mat1b flat(480, 752, static_cast<uint8_t>(grey));
    const Detection detection = Detect(rig, {flat, flat});
    ASSERT_TRUE(std::holds_alternative<Miss>(detection)) << grey;
    EXPECT_EQ(std::get<Miss>(detection).reason, "no_quadrilateral");
  }
  const testing::PlanarTarget speck{.outer_side_m = 1e-6, .border_m = 0.0};
  for (const double noise_dn : {2.0, 20.0, 60.0}) {
    const Photo photo{.wall_dn = 128.0, .noise_dn = noise_dn};
    const auto seen = Photograph(rig, WindowSeenFrom({}), speck, photo, RandomStream(8));
    EXPECT_TRUE(std::holds_alternative<Miss>(Detect(rig, seen))) << noise_dn;
    EXPECT_TRUE(std::holds_alternative<Miss>(Detect(rig, {seen.left, seen.left}))) << noise_dn;
  }
}

TEST(EdgeStereo, OtherSensorsAndSizesAreInputErrors) {
  const EdgeStereoDetector detector(PaperRig(), {});
  StageLog log(SteadyClock());
  EXPECT_EQ(detector.sensor(), SensorKind::kStereo);
  EXPECT_THROW(detector.Detect(RgbdObservation{}, log), InputError);
  EXPECT_THROW(detector.Detect(StereoObservation{}, log), InputError);
  const cv::Mat1b tiny(1, 1, uint8_t{7});
  EXPECT_THROW(detector.Detect(StereoObservation{tiny, tiny}, log), InputError);
}

TEST(EdgeStereo, SmallImagesAreMissedNotFatal) {
  for (const auto& [width, height] : {std::pair{16, 16}, {752, 16}, {16, 480}, {97, 61}}) {
    const CameraModel camera = CameraModel::Pinhole(width, height, 50.0);
    const StereoCalibration rig{camera, camera, Pose::Translation({-0.35, 0.0, 0.0})};
    cv::Mat1f noise(height, width);
    RandomStream(10).FillUniforms({noise.ptr<float>(), noise.total()});
    const cv::Mat1b left = 255.0 * noise;
    EXPECT_TRUE(std::holds_alternative<Miss>(Detect(rig, {left, left}))) << width << ' ' << height;
  }
}

TEST(EdgeStereo, StagesAndPicturesAreLoggedAndNothingIsRemembered) {
  const StereoCalibration rig = PaperRig();
  const auto seen = ExactPair(rig, FrameSeenFrom({}), kNoise_dn, RandomStream(9));
  const EdgeStereoDetector detector(rig, {});
  StageLog log(SteadyClock(), /*keep_artifacts=*/true);
  const WindowEstimate first = Found(detector.Detect(seen, log));
  std::vector<std::string> stages;
  for (const StageTime& time : log.times()) stages.push_back(time.stage);
  EXPECT_THAT(stages,
              ::testing::ElementsAre("rectify", "segments", "propose", "match", "fit", "choose"));
  std::vector<std::string> pictures;
  for (const StagePicture& picture : log.pictures()) pictures.push_back(picture.name);
  EXPECT_THAT(pictures, ::testing::ElementsAre("rectified", "segments", "edge_points"));
  StageLog silent(SteadyClock());
  const WindowEstimate second = Found(detector.Detect(seen, silent));
  EXPECT_EQ(first.p_CO, second.p_CO);
  EXPECT_EQ(*first.covariance_C, *second.covariance_C);
  ASSERT_TRUE(first.score);
  EXPECT_GT(*first.score, 0.5);
  EXPECT_LE(*first.score, 1.0);
}

TEST(EdgeStereoOptionsTest, ValidateNamesAllFaultsAtOnce) {
  EXPECT_NO_THROW(Validate(EdgeStereoOptions{}));
  EdgeStereoOptions bad;
  bad.search.min_darkness = 2.0;
  bad.search.limits.nearest_m = 20.0;
  bad.prior.expected_width_m = 1.0;
  try {
    Validate(bad);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3u) << error.what();
  }
}

}  // namespace
}  // namespace fenestra
