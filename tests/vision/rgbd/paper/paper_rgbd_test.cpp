#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/vision/rgbd/synthetic_kinect.h"
#include "vision/rgbd/paper/paper_rgbd.h"

namespace fenestra {
namespace {

using testing::KinectCalibration;
using testing::Look;
using testing::Observe;
using testing::PoseOfWindow;
using testing::RegisteredCalibration;
using testing::SyntheticKinect;

constexpr double kTenDegrees = 0.1745;

struct Case {
  testing::PlanarTarget target;
  double distance_m;
};

// The square and distances of a 1 m window, and a 0.40 m window at the paper's distances.
const std::vector<Case> kCases = {{{1.0, 0.1}, 1.2}, {{1.0, 0.1}, 1.5},   {{1.0, 0.1}, 2.0},
                                  {{1.0, 0.1}, 3.0}, {{0.4, 0.05}, 0.59}, {{0.4, 0.05}, 0.78}};

const std::vector<Look> kLooks = {
    {},
    {.azimuth_rad = kTenDegrees},
    {.azimuth_rad = -kTenDegrees},
    {.yaw_rad = kTenDegrees},
    {.yaw_rad = -kTenDegrees},
    {.roll_rad = kTenDegrees},
    {.roll_rad = -kTenDegrees},
};

std::array<Eigen::Vector3d, 4> TrueCorners(const Case& given, const Pose& X_DO) {
  const double h = 0.5 * given.target.outer_side_m;
  return {X_DO * Eigen::Vector3d(-h, h, 0.0), X_DO * Eigen::Vector3d(h, h, 0.0),
          X_DO * Eigen::Vector3d(h, -h, 0.0), X_DO * Eigen::Vector3d(-h, -h, 0.0)};
}

bool IsInView(const Case& given, const Pose& X_DO) {
  const RgbdCalibration calibration = KinectCalibration();
  const auto corners = TrueCorners(given, X_DO);
  return std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector3d& p_DV) {
    const auto in_depth = calibration.depth.Project(p_DV);
    const auto in_color = calibration.color.Project(calibration.X_KD * p_DV);
    return in_depth && in_color && calibration.depth.Contains(*in_depth) &&
           calibration.color.Contains(*in_color);
  });
}

Detection DetectOnce(const RgbdCalibration& calibration, const RgbdObservation& observation) {
  StageLog log(SteadyClock());
  return PaperRgbdDetector(calibration, {}).Detect(observation, log);
}

std::string Describe(const Detection& detection) {
  const Miss* miss = std::get_if<Miss>(&detection);
  return miss == nullptr ? "found" : miss->reason + ": " + miss->detail;
}

// The support size that the defaults give a square frame, and its radius: the reach of NARF.
double Reach(const Case& given) {
  return 0.5 * PaperRgbdOptions{}.support_fraction * given.target.outer_side_m;
}

TEST(PaperRgbdAccuracy, FacingWindowWithoutNoiseIsCentredToThePixel) {
  for (const Case& given : kCases) {
    const Pose X_DO = PoseOfWindow({.distance_m = given.distance_m});
    const SyntheticKinect scene{.target = given.target, .X_DO = X_DO};
    const auto detection =
        DetectOnce(KinectCalibration(), Observe(KinectCalibration(), scene, std::nullopt));
    const auto* found = std::get_if<WindowEstimate>(&detection);
    ASSERT_NE(found, nullptr) << Describe(detection);
    // The scene is symmetric, so the four key points are displaced alike and the diagonals cross at
    // the centre but for the pixel grid: each vertex may be off by one pixel in either direction.
    const double pixel_m = given.distance_m / (0.5 * 531.15);
    const Eigen::Vector3d error = found->p_CO - X_DO.translation();
    EXPECT_LT(error.head<2>().norm(), std::sqrt(2.0) * pixel_m) << given.distance_m;
    EXPECT_LT(std::abs(error.z()), 0.0006) << given.distance_m;  // Depth is rounded to 1 mm.
    EXPECT_LT((found->normal_C - X_DO.rotation().col(2)).norm(), 1e-3);
  }
}

TEST(PaperRgbdAccuracy, WindowIsFoundInAllViewsWithTheSensorsNoise) {
  int views = 0;
  for (const Case& given : kCases) {
    for (Look look : kLooks) {
      look.distance_m = given.distance_m;
      const Pose X_DO = PoseOfWindow(look);
      if (!IsInView(given, X_DO)) continue;
      const RandomStream noise = RandomStream(17).Child("view", static_cast<uint64_t>(++views));
      const SyntheticKinect scene{.target = given.target, .X_DO = X_DO};
      const auto detection =
          DetectOnce(KinectCalibration(), Observe(KinectCalibration(), scene, noise));
      const auto* found = std::get_if<WindowEstimate>(&detection);
      ASSERT_NE(found, nullptr) << given.distance_m << " m: " << Describe(detection);
      // Key points lie within NARF's reach of their corners. Displacing the ends of a diagonal by
      // up to ρ displaces it sideways by up to ρ where it crosses the other, at right angles: the
      // crossing moves by up to √2 ρ. Depth: four noises of 1.425e-3 z² and a half step each.
      const double z = given.distance_m;
      EXPECT_LT((found->p_CO - X_DO.translation()).norm(),
                std::sqrt(2.0) * Reach(given) + 5.0 * 1.425e-3 * z * z);
      const auto corners = TrueCorners(given, X_DO);
      for (size_t i = 0; i < 4; ++i) {
        EXPECT_LT((found->p_CV[i] - corners[i]).norm(), std::sqrt(2.0) * Reach(given))
            << "corner " << i << " at " << z << " m";
      }
    }
  }
  EXPECT_GE(views, 30);  // Views that cut the frame do not count.
}

TEST(PaperRgbdAccuracy, VerticesLieInsideOfTheFrame) {
  // The bias that the detector's header states.
  const Case given = kCases[2];
  const Pose X_DO = PoseOfWindow({.distance_m = given.distance_m});
  const SyntheticKinect scene{.target = given.target, .X_DO = X_DO};
  const auto detection =
      DetectOnce(KinectCalibration(), Observe(KinectCalibration(), scene, std::nullopt));
  const auto* found = std::get_if<WindowEstimate>(&detection);
  ASSERT_NE(found, nullptr) << Describe(detection);
  for (const Eigen::Vector3d& p_DV : found->p_CV) {
    const Eigen::Vector3d p_OV = X_DO.inverse() * p_DV;
    const double reach = std::max(std::abs(p_OV.x()), std::abs(p_OV.y()));
    EXPECT_LT(reach, 0.5);
    EXPECT_GT(reach, 0.4);
  }
}

// Edges without mixed pixels, so that a change of the grey values changes no mask.
void Harden(cv::Mat3b& color, int frame_dn, int wall_dn) {
  for (cv::Vec3b& pixel : color) pixel = cv::Vec3b::all(pixel[0] < 80 ? frame_dn : wall_dn);
}

TEST(PaperRgbdAccuracy, BrightnessThatKeepsTheThresholdBetweenFrameAndWallChangesNothing) {
  const RgbdCalibration calibration = RegisteredCalibration();
  const SyntheticKinect scene{
      .target = {}, .X_DO = PoseOfWindow({.distance_m = 2.0, .azimuth_rad = kTenDegrees})};
  RgbdObservation observation = Observe(calibration, scene, RandomStream(4));
  std::vector<Eigen::Vector3d> centroids;
  const std::vector<std::pair<int, int>> greys = {{31, 128}, {0, 50}, {49, 255}};
  for (const auto& [frame_dn, wall_dn] : greys) {
    RgbdObservation scaled = observation;
    scaled.color = observation.color.clone();
    Harden(scaled.color, frame_dn, wall_dn);
    const auto detection = DetectOnce(calibration, scaled);
    ASSERT_TRUE(std::holds_alternative<WindowEstimate>(detection)) << Describe(detection);
    centroids.push_back(std::get<WindowEstimate>(detection).p_CO);
  }
  EXPECT_EQ(centroids[0], centroids[1]);
  EXPECT_EQ(centroids[0], centroids[2]);
  Harden(observation.color, 50, 128);  // The twin that must be rejected.
  EXPECT_EQ(std::get<Miss>(DetectOnce(calibration, observation)).reason, "no_dark_pixels");
}

TEST(PaperRgbdAccuracy, MirroredSceneMirrorsTheEstimate) {
  const RgbdCalibration calibration = RegisteredCalibration();
  Look look{.distance_m = 2.0, .azimuth_rad = kTenDegrees, .yaw_rad = 0.05};
  const SyntheticKinect scene{.target = {}, .X_DO = PoseOfWindow(look)};
  const RgbdObservation observation = Observe(calibration, scene, RandomStream(8));
  RgbdObservation mirrored;
  cv::flip(observation.color, mirrored.color, 1);
  cv::flip(observation.depth.raw, mirrored.depth.raw, 1);
  const auto detection = DetectOnce(calibration, observation);
  const auto reflection = DetectOnce(calibration, mirrored);
  ASSERT_TRUE(std::holds_alternative<WindowEstimate>(detection)) << Describe(detection);
  ASSERT_TRUE(std::holds_alternative<WindowEstimate>(reflection)) << Describe(reflection);
  const auto& estimate = std::get<WindowEstimate>(detection);
  const auto& mirror = std::get<WindowEstimate>(reflection);
  // Thinning takes the other columns, and PCL's sparse interest image depends on the order of the
  // pixels, which moves a vertex by up to a quarter of NARF's reach before noise.
  const Eigen::Vector3d flipped(-mirror.p_CO.x(), mirror.p_CO.y(), mirror.p_CO.z());
  EXPECT_LT((flipped - estimate.p_CO).norm(), 0.25 * 0.1);
  // The triples that propose the plane differ, and with them which points at the tolerance's edge
  // count: a part of the normal's standard error, σ_z / (0.4 m √N) = 8e-5 for N = 3e4.
  EXPECT_LT(std::abs(mirror.normal_C.x() + estimate.normal_C.x()), 5.0 * 8e-5);
}

TEST(PaperRgbdAccuracy, DarkThingOffTheFramesPlaneIsPassedOver) {
  const RgbdCalibration calibration = RegisteredCalibration();
  const SyntheticKinect scene{.target = {}, .X_DO = PoseOfWindow({.distance_m = 2.0})};
  RgbdObservation observation = Observe(calibration, scene, RandomStream(4));
  const cv::Rect thing(20, 20, 60, 60);
  observation.color(thing) = cv::Vec3b(0, 0, 0);
  observation.depth.raw(thing) = 1500;
  const auto detection = DetectOnce(calibration, observation);
  ASSERT_TRUE(std::holds_alternative<WindowEstimate>(detection)) << Describe(detection);
  EXPECT_LT((std::get<WindowEstimate>(detection).p_CO - scene.X_DO.translation()).norm(), 0.05);
}

}  // namespace
}  // namespace fenestra
