#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/io/input_error.h"
#include "tests/vision/rgbd/synthetic_kinect.h"
#include "vision/rgbd/paper/paper_rgbd.h"

namespace fenestra {
namespace {

using ::testing::ElementsAre;
using testing::KinectCalibration;
using testing::Observe;
using testing::PoseOfWindow;
using testing::SyntheticKinect;

RgbdObservation Uniform(const RgbdCalibration& calibration, int grey, int raw_depth) {
  RgbdObservation observation;
  observation.color = cv::Mat3b(calibration.color.height_px(), calibration.color.width_px(),
                                cv::Vec3b::all(static_cast<uchar>(grey)));
  observation.depth.raw = cv::Mat1w(calibration.depth.height_px(), calibration.depth.width_px(),
                                    static_cast<ushort>(raw_depth));
  observation.depth.unit_m = calibration.depth_unit_m;
  return observation;
}

std::string ReasonOf(const RgbdCalibration& calibration, const RgbdObservation& observation,
                     const PaperRgbdOptions& options = {}) {
  StageLog log(SteadyClock());
  const auto detection = PaperRgbdDetector(calibration, options).Detect(observation, log);
  const Miss* miss = std::get_if<Miss>(&detection);
  return miss == nullptr ? "found" : miss->reason;
}

RgbdObservation Window() {
  const SyntheticKinect scene{.target = {}, .X_DO = PoseOfWindow({.distance_m = 2.0})};
  return Observe(KinectCalibration(), scene, RandomStream(1));
}

TEST(PaperRgbdLimits, EveryMissSaysWhy) {
  const RgbdCalibration kinect = KinectCalibration();
  EXPECT_EQ(ReasonOf(kinect, Uniform(kinect, 255, 2000)), "no_dark_pixels");
  EXPECT_EQ(ReasonOf(kinect, Uniform(kinect, 0, 0)), "no_depth_on_dark_pixels");

  RgbdObservation speck = Uniform(kinect, 255, 2000);
  speck.color(cv::Rect(300, 200, 8, 8)) = cv::Vec3b(0, 0, 0);
  EXPECT_EQ(ReasonOf(kinect, speck), "cloud_too_small");

  RgbdObservation line = Uniform(kinect, 255, 2000);
  line.color(cv::Rect(100, 200, 400, 2)) = cv::Vec3b(0, 0, 0);
  EXPECT_EQ(ReasonOf(kinect, line), "no_plane");

  RgbdObservation bar = Uniform(kinect, 255, 2000);
  bar.color(cv::Rect(100, 200, 400, 30)) = cv::Vec3b(0, 0, 0);
  EXPECT_EQ(ReasonOf(kinect, bar), "implausible_shape");
}

TEST(PaperRgbdLimits, FrameIsInvisibleToNarfUnlessUnseenIsFar) {
  PaperRgbdOptions options;
  EXPECT_EQ(ReasonOf(KinectCalibration(), Window(), options), "found");
  options.unseen_is_far = false;
  EXPECT_EQ(ReasonOf(KinectCalibration(), Window(), options), "too_few_key_points");
}

TEST(PaperRgbdLimits, BlackImagesEndOrdinarily) {
  // All black at all depths, with depth in every second pixel only, and at the ends of 16 bits.
  const RgbdCalibration calibration{.color = CameraModel::Pinhole(64, 48, 53.0),
                                    .depth = CameraModel::Pinhole(64, 48, 57.0),
                                    .X_KD = KinectCalibration().X_KD,
                                    .depth_unit_m = 0.001};
  for (const int raw_depth : {1, 1000, 65535}) {
    RgbdObservation black = Uniform(calibration, 0, raw_depth);
    EXPECT_FALSE(ReasonOf(calibration, black).empty());
    for (int v = 0; v < 48; ++v) {
      for (int u = v % 2; u < 64; u += 2) black.depth.raw(v, u) = 0;
    }
    EXPECT_FALSE(ReasonOf(calibration, black).empty());
  }
}

TEST(PaperRgbdLimits, OnePixelIsACloudTooSmall) {
  const RgbdCalibration calibration{.color = CameraModel::Pinhole(1, 1, 1.0),
                                    .depth = CameraModel::Pinhole(1, 1, 1.0),
                                    .X_KD = Pose(),
                                    .depth_unit_m = 0.001};
  EXPECT_EQ(ReasonOf(calibration, Uniform(calibration, 0, 1000)), "cloud_too_small");
}

TEST(PaperRgbdLimits, WrongInputIsRefused) {
  const RgbdCalibration kinect = KinectCalibration();
  StageLog log(SteadyClock());
  const PaperRgbdDetector detector(kinect, {});
  EXPECT_THROW(detector.Detect(StereoObservation{}, log), InputError);
  EXPECT_THROW(detector.Detect(RgbdObservation{}, log), InputError);

  PaperRgbdOptions options;
  options.support_fraction = -1.0;
  EXPECT_THROW(PaperRgbdDetector(kinect, options), InputError);

  RgbdCalibration wide = kinect;
  wide.color = CameraModel::Pinhole(640, 480, 300.0);  // 93.7°.
  EXPECT_THROW(PaperRgbdDetector(wide, {}), InputError);
  RgbdCalibration unitless = kinect;
  unitless.depth_unit_m = 0.0;
  EXPECT_THROW(PaperRgbdDetector(unitless, {}), InputError);
}

TEST(PaperRgbdLimits, LogHoldsTheStagesPicturesAndCloud) {
  StageLog log(SteadyClock(), true);
  PaperRgbdDetector(KinectCalibration(), {}).Detect(Window(), log);
  std::vector<std::string> stages;
  for (const StageTime& time : log.times()) stages.push_back(time.stage);
  EXPECT_THAT(stages,
              ElementsAre("register", "segment", "range_image", "narf", "vertices", "centroid"));
  std::vector<std::string> pictures;
  for (const StagePicture& picture : log.pictures()) {
    pictures.push_back(picture.name);
    EXPECT_EQ(picture.image.type(), CV_8UC3);
    ASSERT_EQ(picture.views.size(), 1u);
    EXPECT_EQ(picture.image.cols, picture.views[0].camera.width_px());
  }
  EXPECT_THAT(pictures, ElementsAre("registered_depth", "segmentation", "range_image"));
  ASSERT_EQ(log.clouds().size(), 1u);
  EXPECT_EQ(log.clouds()[0].name, "cloud");
  EXPECT_GT(log.clouds()[0].points_C.size(), 1000u);
}

TEST(PaperRgbdLimits, LookingAtArtifactsChangesNoEstimate) {
  const PaperRgbdDetector detector(KinectCalibration(), {});
  const RgbdObservation window = Window();
  StageLog watched(SteadyClock(), true);
  StageLog unwatched(SteadyClock());
  const auto first = detector.Detect(window, watched);
  const auto second = detector.Detect(window, unwatched);
  EXPECT_EQ(std::get<WindowEstimate>(first).p_CO, std::get<WindowEstimate>(second).p_CO);
  EXPECT_EQ(std::get<WindowEstimate>(first).p_CV, std::get<WindowEstimate>(second).p_CV);
}

}  // namespace
}  // namespace fenestra
