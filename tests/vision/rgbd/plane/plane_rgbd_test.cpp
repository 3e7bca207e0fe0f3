#include "vision/rgbd/plane/plane_rgbd.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <boost/math/distributions/chi_squared.hpp>
#include <opencv2/imgproc.hpp>

#include "core/io/input_error.h"
#include "tests/vision/rgbd/plane/exact_kinect.h"
#include "tests/vision/rgbd/synthetic_kinect.h"

namespace fenestra {
namespace {

using testing::ExactKinectNoise;
using testing::ExactKinectPicture;
using testing::ExactKinectScene;
using testing::KinectCalibration;
using testing::Look;
using testing::PoseOfWindow;
using testing::RegisteredCalibration;

constexpr double kChi3 = 16.27;  // χ² of 3 degrees of freedom, 1e-3.

Detection Detect(const RgbdCalibration& calibration, const RgbdObservation& observation,
                 const PlaneRgbdOptions& options = {}) {
  StageLog log(SteadyClock());
  return PlaneRgbdDetector(calibration, options).Detect(observation, log);
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

ExactKinectScene SceneAt(const Look& look, double side_m = 1.0) {
  ExactKinectScene scene;
  scene.frame.X_LO = PoseOfWindow(look);
  scene.frame.width_m = scene.frame.height_m = side_m;
  return scene;
}

RgbdObservation Seen(const RgbdCalibration& calibration, const ExactKinectScene& scene,
                     uint64_t seed, const ExactKinectNoise& noise = {}) {
  return testing::WithNoise(testing::ExactPicture(calibration, scene), calibration, noise,
                            RandomStream(seed));
}

double SquaredError(const WindowEstimate& estimate, const Eigen::Vector3d& p_DO) {
  if (!estimate.covariance_C) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d error = estimate.p_CO - p_DO;
  return error.dot(estimate.covariance_C->inverse() * error);
}

struct Sight {
  Look look;
  bool registered = false;
};
class PlaneRgbdFinds : public ::testing::TestWithParam<Sight> {};

TEST_P(PlaneRgbdFinds, TheFrameOfAnExactPicture) {
  const RgbdCalibration calibration =
      GetParam().registered ? RegisteredCalibration() : KinectCalibration();
  const ExactKinectScene scene = SceneAt(GetParam().look);
  const ExactKinectNoise none{.color_dn = 0.0, .inverse_depth = 0.0, .step = 0.0};
  const WindowEstimate estimate = Found(Detect(calibration, Seen(calibration, scene, 1, none)));
  // Depth rounded to 1 mm, with the same error for pixels at the same depth: up to 0.5 mm. Edges
  // are right to 0.01 px, see edge_stereo_test.
  const double z_m = scene.frame.X_LO.translation().z();
  const double allowed_m = 0.5e-3 + 0.01 * z_m / 525.0;
  EXPECT_LT((estimate.p_CO - scene.frame.X_LO.translation()).norm(), allowed_m);
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p_OV(i == 1 || i == 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5, 0.0);
    EXPECT_LT((estimate.p_CV[i] - scene.frame.X_LO * p_OV).norm(), 3.0 * allowed_m) << i;
  }
  EXPECT_GT(estimate.normal_C.dot(scene.frame.X_LO.rotation().col(2)), std::cos(0.004));
}

INSTANTIATE_TEST_SUITE_P(
    Views, PlaneRgbdFinds,
    ::testing::Values(Sight{{.distance_m = 1.5, .azimuth_rad = 0.05}},
                      Sight{{.distance_m = 2.0, .azimuth_rad = 0.05, .roll_rad = 0.1}},
                      Sight{{.distance_m = 2.5, .azimuth_rad = 0.8, .yaw_rad = 0.05}},
                      Sight{{.distance_m = 3.5, .azimuth_rad = -0.5, .roll_rad = -0.2}},
                      Sight{{.distance_m = 2.0, .azimuth_rad = -0.4}, true},
                      Sight{{.distance_m = 3.0, .azimuth_rad = 0.1}, true}));

TEST(PlaneRgbd, ScalingTheWorldScalesTheEstimate) {
  const RgbdCalibration small = KinectCalibration();
  RgbdCalibration big = small;
  big.depth_unit_m *= 3.0;
  big.X_KD = Pose::Translation(3.0 * small.X_KD.translation());
  RgbdObservation seen = Seen(small, SceneAt({.distance_m = 2.0, .azimuth_rad = 0.2}), 3);
  PlaneRgbdOptions options;
  for (double* length : {&options.search.limits.nearest_m, &options.search.limits.farthest_m,
                         &options.search.limits.min_side_m, &options.search.limits.max_side_m,
                         &options.search.min_border_m}) {
    *length *= 3.0;
  }
  options.depth_to_m *= 3.0;
  options.depth_noise_per_m /= 3.0;
  options.depth_step_per_m /= 3.0;
  const WindowEstimate one = Found(Detect(small, seen));
  seen.depth.unit_m *= 3.0;
  const WindowEstimate three = Found(Detect(big, seen, options));
  // The same pixels in another unit of length. Iterations end below 3e-4 standard deviations.
  EXPECT_LT((3.0 * one.p_CO - three.p_CO).norm(), 1e-3 * std::sqrt(three.covariance_C->trace()));
  EXPECT_LT((9.0 * *one.covariance_C - *three.covariance_C).norm(),
            1e-3 * three.covariance_C->norm());
}

TEST(PlaneRgbd, TwiceTheLightChangesNothingButTheNoise) {
  const RgbdCalibration calibration = KinectCalibration();
  ExactKinectScene scene = SceneAt({.distance_m = 2.0, .azimuth_rad = 0.2});
  const WindowEstimate dim = Found(Detect(calibration, Seen(calibration, scene, 4)));
  scene.frame.wall_dn *= 2.0;
  scene.frame.frame_dn *= 2.0;
  scene.frame.opening_dn *= 2.0;
  const WindowEstimate bright = Found(Detect(calibration, Seen(calibration, scene, 4)));
  // Depth is the same, and so is its error: what is left is the noise of edges, which is a
  // hundredth of a pixel for a side, and what that lets depth move in the balance of tilts.
  EXPECT_LT((dim.p_CO - bright.p_CO).norm(), 0.1 * std::sqrt(dim.covariance_C->trace()));
  EXPECT_NEAR(bright.covariance_C->trace() / dim.covariance_C->trace(), 1.0, 0.1);
}

struct Trials {
  int count = 0;
  double normalised_square = 0.0;
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

Trials Try(const Look& look, int count) {
  const RgbdCalibration calibration = KinectCalibration();
  const ExactKinectScene scene = SceneAt(look);
  const ExactKinectPicture picture = testing::ExactPicture(calibration, scene);
  Trials trials;
  for (int i = 0; i < count; ++i) {
    const auto stream = RandomStream(7).Child("trial", static_cast<uint64_t>(i));
    const WindowEstimate estimate =
        Found(Detect(calibration, testing::WithNoise(picture, calibration, {}, stream)));
    if (!estimate.covariance_C) return trials;
    const Eigen::Vector3d error = estimate.p_CO - scene.frame.X_LO.translation();
    trials.normalised_square += SquaredError(estimate, scene.frame.X_LO.translation());
    trials.square += error * error.transpose() / count;
    trials.covariance += *estimate.covariance_C / count;
    ++trials.count;
  }
  return trials;
}

const std::array<Look, 3> kLooks = {Look{.distance_m = 1.5, .azimuth_rad = 0.1, .roll_rad = 0.07},
                                    Look{.distance_m = 2.4, .azimuth_rad = -0.6, .roll_rad = 0.04},
                                    Look{.distance_m = 3.5, .azimuth_rad = 0.2, .yaw_rad = 0.05}};

// Two-sided 1 % test of the mean normalised squared error, 3 degrees of freedom each.
bool IsHonest(double normalised_square, int count) {
  const boost::math::chi_squared distribution(3.0 * count);
  return normalised_square > quantile(distribution, 0.005) &&
         normalised_square < quantile(distribution, 0.995);
}

TEST(PlaneRgbd, CovarianceIsHonest) {
  double sum = 0.0;
  int count = 0;
  for (const Look& look : kLooks) {
    const Trials trials = Try(look, 60);
    sum += trials.normalised_square;
    count += trials.count;
  }
  ASSERT_EQ(count, 180);
  EXPECT_TRUE(IsHonest(sum, count)) << sum / count << " of 3 in the mean";
  // The twin with a fault: a covariance of half the size, or twice.
  EXPECT_FALSE(IsHonest(2.0 * sum, count));
  EXPECT_FALSE(IsHonest(0.5 * sum, count));
}

// Cramér and Rao's bound of the centroid's covariance. Parameters: place and turn of the frame, its
// sizes and border, three grey values and the blur; depth depends on the first six.
class Bound {
 public:
  Bound(const RgbdCalibration& calibration, const ExactKinectScene& scene)
      : calibration_(calibration), scene_(scene) {
    for (int i = 0; i < kParameters; ++i) {
      const double step = i < 9 ? 1e-3 : i < 12 ? 1.0 : 0.02;
      const ExactKinectPicture more = testing::ExactPicture(calibration, Changed(i, step));
      const ExactKinectPicture less = testing::ExactPicture(calibration, Changed(i, -step));
      color_.push_back((more.linear_dn - less.linear_dn) / (2.0 * step));
      // A pixel that comes or goes with the frame's edge tells nothing of a depth.
      const cv::Mat1f both = more.inverse_depth.mul(less.inverse_depth);
      cv::Mat1f depth = (more.inverse_depth - less.inverse_depth) / (2.0 * step);
      depth.setTo(0.0f, both == 0.0f);
      depth_.push_back(depth);
    }
  }

  Eigen::Matrix3d OfCentroid(const ExactKinectNoise& noise) const {
    // Three channels with the same edges; their encoding adds little.
    const double grey = noise.color_dn * noise.color_dn / 3.0;
    // Windows of 9 x 9 in a 640-wide image: 4.5 x 4.5 depth pixels know as much as one.
    const double depth =
        (noise.inverse_depth * noise.inverse_depth + noise.step * noise.step / 12.0) * 4.5 * 4.5;
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kParameters, kParameters);
    for (size_t i = 0; i < kParameters; ++i) {
      for (size_t j = 0; j < kParameters; ++j) {
        information(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            color_[i].dot(color_[j]) / grey + depth_[i].dot(depth_[j]) / depth;
      }
    }
    return information.inverse().topLeftCorner<3, 3>();
  }

 private:
  static constexpr int kParameters = 13;

  ExactKinectScene Changed(int parameter, double by) const {
    ExactKinectScene scene = scene_;
    testing::ExactFrame& f = scene.frame;
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    if (parameter < 3) shift[parameter] = by;
    if (parameter >= 3 && parameter < 6) turn[parameter - 3] = by;
    f.X_LO = Pose(f.X_LO.rotation() * RotationFromVector(turn), f.X_LO.translation() + shift);
    double* others[] = {&f.width_m,  &f.height_m,   &f.border_m, &f.wall_dn,
                        &f.frame_dn, &f.opening_dn, &f.blur_px};
    if (parameter >= 6) *others[parameter - 6] += by;
    return scene;
  }

  RgbdCalibration calibration_;
  ExactKinectScene scene_;
  std::vector<cv::Mat1d> color_;
  std::vector<cv::Mat1d> depth_;
};

TEST(PlaneRgbd, ErrorIsNearTheCramerRaoBound) {
  for (const Look& look : kLooks) {
    const Eigen::Matrix3d bound = Bound(KinectCalibration(), SceneAt(look)).OfCentroid({});
    const Trials trials = Try(look, 60);
    ASSERT_EQ(trials.count, 60);
    for (int axis = 0; axis < 3; ++axis) {
      const double ratio = std::sqrt(trials.square(axis, axis) / bound(axis, axis));
      // The root mean square of 60 has a standard deviation of 9 %.
      EXPECT_GT(ratio, 0.75) << look.distance_m << " m, axis " << axis;
      EXPECT_LT(ratio, 2.0) << look.distance_m << " m, axis " << axis;
    }
  }
}

TEST(PlaneRgbd, ARoomBehindThePaneIsNoWall) {
  const RgbdCalibration calibration = KinectCalibration();
  for (const double room_m : {-1.0, 0.05, 0.5, 2.0}) {
    ExactKinectScene scene = SceneAt({.distance_m = 2.0, .azimuth_rad = 0.2});
    scene.opening_m = room_m;
    scene.frame.opening_dn = 20.0;
    const WindowEstimate estimate = Found(Detect(calibration, Seen(calibration, scene, 5)));
    EXPECT_LT(SquaredError(estimate, scene.frame.X_LO.translation()), kChi3) << room_m;
  }
}

TEST(PlaneRgbd, AFrameBehindTheWallIsWhereTheOptionSays) {
  const RgbdCalibration calibration = KinectCalibration();
  ExactKinectScene scene = SceneAt({.distance_m = 2.0, .azimuth_rad = 0.1});
  scene.setback_m = 0.1;
  const RgbdObservation seen = Seen(calibration, scene, 6);
  const Eigen::Vector3d truth = scene.frame.X_LO.translation();
  PlaneRgbdOptions known;
  known.setback_m = 0.1;
  EXPECT_LT(SquaredError(Found(Detect(calibration, seen, known)), truth), kChi3);
  // Not known, and without depth of its own: the covariance says so.
  PlaneRgbdOptions vague;
  vague.setback_m = 0.05;
  vague.setback_sigma_m = 0.05;
  const WindowEstimate estimate = Found(Detect(calibration, seen, vague));
  EXPECT_LT(SquaredError(estimate, truth), kChi3);
  EXPECT_NEAR(std::sqrt((*estimate.covariance_C)(2, 2)), 0.05, 0.01);
}

TEST(PlaneRgbd, OfAFrameWithoutDepthNoMoreIsSaidThanIsKnown) {
  const RgbdCalibration calibration = KinectCalibration();
  for (const double setback_m : {0.0, 0.05, 0.10}) {
    for (const double azimuth_rad : {0.1, 0.6}) {
      ExactKinectScene scene = SceneAt({.distance_m = 2.0, .azimuth_rad = azimuth_rad});
      scene.setback_m = setback_m;
      scene.opening_m = 3.0;  // A room: the frame is not painted on the wall.
      scene.frame.opening_dn = 20.0;
      const RgbdObservation seen = Seen(calibration, scene, 8);
      const Eigen::Vector3d truth = scene.frame.X_LO.translation();
      EXPECT_LT(SquaredError(Found(Detect(calibration, seen)), truth), kChi3) << setback_m;
      // The twin with a fault: told that frames are flush.
      PlaneRgbdOptions flush;
      flush.setback_sigma_m = 0.0;
      const double square = SquaredError(Found(Detect(calibration, seen, flush)), truth);
      EXPECT_EQ(square > kChi3, setback_m > 0.0) << setback_m;
    }
  }
}

TEST(PlaneRgbd, AFrameThatIsNotWhereItWasSaidToBeIsRefused) {
  const RgbdCalibration calibration = KinectCalibration();
  ExactKinectScene scene = SceneAt({.distance_m = 1.6, .azimuth_rad = 0.1});
  scene.frame_returns = true;
  scene.setback_m = 0.04;
  PlaneRgbdOptions options;
  options.setback_m = 0.15;
  options.setback_sigma_m = 0.005;
  const Detection detection = Detect(calibration, Seen(calibration, scene, 9), options);
  ASSERT_TRUE(std::holds_alternative<Miss>(detection));
  EXPECT_EQ(std::get<Miss>(detection).reason, "unexpected_setback");
  options.setback_sigma_m = 0.1;
  Found(Detect(calibration, Seen(calibration, scene, 9), options));
}

TEST(PlaneRgbd, AFrameWithDepthOfItsOwnTellsHowFarItIsBehindTheWall) {
  const RgbdCalibration calibration = KinectCalibration();
  ExactKinectScene scene = SceneAt({.distance_m = 1.6, .azimuth_rad = 0.1});
  scene.frame_returns = true;
  for (const double setback_m : {0.0, 0.04, 0.08, 0.12}) {
    scene.setback_m = setback_m;
    const WindowEstimate estimate = Found(Detect(calibration, Seen(calibration, scene, 7)));
    EXPECT_LT(SquaredError(estimate, scene.frame.X_LO.translation()), kChi3) << setback_m;
  }
}

TEST(PlaneRgbd, HolesInTheWallOnlyAddNoise) {
  const RgbdCalibration calibration = KinectCalibration();
  const ExactKinectScene scene = SceneAt({.distance_m = 2.0, .azimuth_rad = 0.2});
  RgbdObservation seen = Seen(calibration, scene, 8);
  const double before = Found(Detect(calibration, seen)).covariance_C->trace();
  cv::Mat1f uniform(seen.depth.raw.size());
  RandomStream(8).FillUniforms({uniform.ptr<float>(), uniform.total()});
  seen.depth.raw.setTo(0, uniform < 0.7f);
  const WindowEstimate estimate = Found(Detect(calibration, seen));
  EXPECT_LT(SquaredError(estimate, scene.frame.X_LO.translation()), kChi3);
  EXPECT_GT(estimate.covariance_C->trace(), before);
}

TEST(PlaneRgbd, KnownSizeHelpsAndAWrongOneFindsNothing) {
  const RgbdCalibration calibration = KinectCalibration();
  const ExactKinectScene scene = SceneAt({.distance_m = 3.5, .azimuth_rad = 0.1});
  const RgbdObservation seen = Seen(calibration, scene, 9);
  PlaneRgbdOptions options;
  options.prior.expected_width_m = options.prior.expected_height_m = 1.0;
  options.prior.expected_size_sigma_m = 1e-4;
  const WindowEstimate free = Found(Detect(calibration, seen));
  const WindowEstimate known = Found(Detect(calibration, seen, options));
  EXPECT_LT((*known.covariance_C)(2, 2), (*free.covariance_C)(2, 2));
  EXPECT_LT(SquaredError(known, scene.frame.X_LO.translation()), kChi3);
  options.prior.expected_width_m = 1.4;
  const Detection wrong = Detect(calibration, seen, options);
  ASSERT_TRUE(std::holds_alternative<Miss>(wrong));
  EXPECT_EQ(std::get<Miss>(wrong).reason, "unexpected_size");
}

TEST(PlaneRgbd, ADarkOpeningInABrightFrameIsNoFrame) {
  // All that is dark is far behind what surrounds it.
  const RgbdCalibration calibration = KinectCalibration();
  ExactKinectScene scene = SceneAt({.distance_m = 2.0, .azimuth_rad = 0.1});
  scene.frame.border_m = 0.001;
  scene.frame.opening_dn = scene.frame.frame_dn;
  scene.opening_m = 1.0;
  const Detection detection = Detect(calibration, Seen(calibration, scene, 10));
  ASSERT_TRUE(std::holds_alternative<Miss>(detection));
  EXPECT_EQ(std::get<Miss>(detection).reason, "open_border");
}

TEST(PlaneRgbd, SeesNoWindowWhereThereIsNone) {
  const RgbdCalibration calibration = KinectCalibration();
  ExactKinectScene scene = SceneAt({.distance_m = 2.0, .azimuth_rad = 0.1});
  RgbdObservation seen = Seen(calibration, scene, 11);
  for (const double grey : {0.0, 128.0, 255.0}) {
    RgbdObservation flat = seen;
    flat.color = cv::Mat3b(seen.color.size(), cv::Vec3b::all(static_cast<uint8_t>(grey)));
    const Detection detection = Detect(calibration, flat);
    ASSERT_TRUE(std::holds_alternative<Miss>(detection)) << grey;
    EXPECT_EQ(std::get<Miss>(detection).reason, "no_quadrilateral");
  }
  RgbdObservation noise = seen;
  cv::Mat3f uniform(seen.color.size());
  RandomStream(12).FillUniforms({uniform.ptr<float>(), 3 * uniform.total()});
  noise.color = 255.0 * uniform;
  EXPECT_TRUE(std::holds_alternative<Miss>(Detect(calibration, noise)));
}

TEST(PlaneRgbd, WithoutDepthOrWithNoiseForDepthItSaysSo) {
  const RgbdCalibration calibration = KinectCalibration();
  const RgbdObservation seen =
      Seen(calibration, SceneAt({.distance_m = 2.0, .azimuth_rad = 0.1}), 13);
  RgbdObservation blind = seen;
  blind.depth.raw = cv::Mat1w::zeros(seen.depth.raw.size());
  const Detection detection = Detect(calibration, blind);
  ASSERT_TRUE(std::holds_alternative<Miss>(detection));
  EXPECT_EQ(std::get<Miss>(detection).reason, "no_depth");
  RgbdObservation noise = seen;
  cv::Mat1f uniform(seen.depth.raw.size());
  RandomStream(14).FillUniforms({uniform.ptr<float>(), uniform.total()});
  noise.depth.raw = 65535.0 * uniform;
  EXPECT_TRUE(std::holds_alternative<Miss>(Detect(calibration, noise)));
  noise.depth.raw = cv::Mat1w(seen.depth.raw.size(), uint16_t{65535});
  EXPECT_TRUE(std::holds_alternative<Miss>(Detect(calibration, noise)));
}

TEST(PlaneRgbd, OtherSensorsSizesAndUnitsAreInputErrors) {
  const RgbdCalibration calibration = KinectCalibration();
  const PlaneRgbdDetector detector(calibration, {});
  StageLog log(SteadyClock());
  EXPECT_EQ(detector.sensor(), SensorKind::kRgbd);
  EXPECT_THROW(detector.Detect(StereoObservation{}, log), InputError);
  EXPECT_THROW(detector.Detect(RgbdObservation{}, log), InputError);
  RgbdObservation seen = Seen(calibration, SceneAt({.distance_m = 2.0}), 15);
  seen.depth.unit_m = 0.01;
  EXPECT_THROW(detector.Detect(seen, log), InputError);
  RgbdCalibration bad = calibration;
  bad.depth_unit_m = 0.0;
  EXPECT_THROW(PlaneRgbdDetector(bad, {}), InputError);
}

TEST(PlaneRgbd, SmallImagesAreMissedNotFatal) {
  for (const auto& [width, height] : {std::pair{1, 1}, {16, 16}, {640, 16}, {16, 480}, {97, 61}}) {
    const CameraModel camera = CameraModel::Pinhole(width, height, 50.0);
    const RgbdCalibration calibration{camera, camera, Pose(), 0.001};
    cv::Mat1f noise(height, width);
    RandomStream(16).FillUniforms({noise.ptr<float>(), noise.total()});
    RgbdObservation seen{.color = {}, .depth = {.raw = 5000.0 * noise, .unit_m = 0.001}};
    cv::cvtColor(cv::Mat1b(255.0 * noise), seen.color, cv::COLOR_GRAY2BGR);
    EXPECT_TRUE(std::holds_alternative<Miss>(Detect(calibration, seen))) << width << ' ' << height;
  }
}

TEST(PlaneRgbd, StagesAndPicturesAreLoggedAndNothingIsRemembered) {
  const RgbdCalibration calibration = KinectCalibration();
  const auto seen = Seen(calibration, SceneAt({.distance_m = 2.0, .azimuth_rad = 0.1}), 17);
  const PlaneRgbdDetector detector(calibration, {});
  StageLog log(SteadyClock(), /*keep_artifacts=*/true);
  const WindowEstimate first = Found(detector.Detect(seen, log));
  std::vector<std::string> stages;
  for (const StageTime& time : log.times()) stages.push_back(time.stage);
  EXPECT_THAT(stages,
              ::testing::ElementsAre("read", "segments", "propose", "plane", "fit", "choose"));
  std::vector<std::string> pictures;
  for (const StagePicture& picture : log.pictures()) pictures.push_back(picture.name);
  EXPECT_THAT(pictures, ::testing::ElementsAre("segments", "edge_points", "depth_use"));
  StageLog silent(SteadyClock());
  const WindowEstimate second = Found(detector.Detect(seen, silent));
  EXPECT_EQ(first.p_CO, second.p_CO);
  EXPECT_EQ(*first.covariance_C, *second.covariance_C);
  ASSERT_TRUE(first.score);
  EXPECT_GT(*first.score, 0.5);
  EXPECT_LE(*first.score, 1.0);
}

TEST(PlaneRgbdOptionsTest, ValidateNamesAllFaultsAtOnce) {
  EXPECT_NO_THROW(Validate(PlaneRgbdOptions{}));
  PlaneRgbdOptions bad;
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
