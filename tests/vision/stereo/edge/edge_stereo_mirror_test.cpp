#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/mirrored_estimate.h"
#include "tests/vision/frame/exact_frame.h"
#include "tests/vision/stereo/stereo_scene.h"
#include "vision/stereo/edge/edge_stereo.h"

// Mirrored: each picture flipped, the two exchanged, and the calibration with them.

namespace fenestra {
namespace {

using testing::ExactFrame;
using testing::ExactPicture;
using testing::PaperRig;
using testing::View;
using testing::WindowSeenFrom;
using testing::WithNoise;

constexpr double kMirrorBaseline_m = 0.35;
constexpr double kMirrorNoise_dn = 2.0;

Detection DetectBeside(const StereoCalibration& rig, const StereoObservation& observation) {
  StageLog log(SteadyClock());
  return EdgeStereoDetector(rig, testing::OptionsForExactPictures()).Detect(observation, log);
}

WindowEstimate EstimateIn(const Detection& detection) {
  const auto* estimate = std::get_if<WindowEstimate>(&detection);
  EXPECT_NE(estimate, nullptr) << std::get<Miss>(detection).detail;
  return estimate == nullptr ? WindowEstimate{} : *estimate;
}

StereoObservation Mirrored(const StereoObservation& seen) {
  StereoObservation mirrored;
  cv::flip(seen.right, mirrored.left, 1);
  cv::flip(seen.left, mirrored.right, 1);
  return mirrored;
}

// Mirrored, x becomes B - x: the mirrored right camera is the left one.
double LargestDifference(const WindowEstimate& one, const WindowEstimate& mirrored) {
  return testing::DistanceFromMirrored(one, kMirrorBaseline_m, mirrored);
}

// The same pixels and the same steps, so what differs is the order in which sums are rounded. That
// is 1e-15 of a value at each step, and more only through iterations that end below 1e-3 px (edges)
// and 3e-4 standard deviations (the frame): 1e-9 m has been seen. A pixel more or less in one of
// some hundred strips would be 1e-6 m.
constexpr double kRounding_m = 2e-8;

class EdgeStereoMirror : public ::testing::TestWithParam<View> {};

TEST_P(EdgeStereoMirror, MirroredImagesMirrorTheEstimateExactly) {
  const StereoCalibration rig = PaperRig();
  const ExactFrame frame{.X_LO = WindowSeenFrom(GetParam())};
  const cv::Mat1f left = ExactPicture(rig.left, Pose(), frame);
  const cv::Mat1f right = ExactPicture(rig.right, rig.X_RL, frame);
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const StereoObservation seen = WithNoise(left, right, kMirrorNoise_dn, RandomStream(seed));
    const WindowEstimate one = EstimateIn(DetectBeside(rig, seen));
    const WindowEstimate other = EstimateIn(DetectBeside(rig, Mirrored(seen)));
    EXPECT_LT(LargestDifference(one, other), kRounding_m) << seed;
    EXPECT_NEAR(other.covariance_C->trace() / one.covariance_C->trace(), 1.0, 1e-6);
    // The twin with a fault: one grey value in one pixel of the frame's edge.
    StereoObservation touched = seen;
    const auto corner = rig.left.Project(one.p_CV[0] + 0.4 * (one.p_CV[1] - one.p_CV[0]));
    uint8_t& pixel = touched.left(static_cast<int>(std::lround(corner->y())),
                                  static_cast<int>(std::lround(corner->x())));
    pixel = static_cast<uint8_t>(pixel + (pixel < 128 ? 8 : -8));
    EXPECT_GT(LargestDifference(EstimateIn(DetectBeside(rig, touched)), other), kRounding_m)
        << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Views, EdgeStereoMirror,
    ::testing::Values(View{.distance_m = 2.0, .azimuth_deg = 3.0}, View{.distance_m = 3.0},
                      View{.distance_m = 3.0, .azimuth_deg = -30.0, .roll_deg = 5.0},
                      View{.distance_m = 4.0, .azimuth_deg = 50.0, .pitch_deg = 3.0},
                      View{.distance_m = 6.0, .yaw_deg = -5.0, .pitch_deg = 5.0, .roll_deg = 15.0},
                      View{.distance_m = 8.0, .azimuth_deg = 40.0},
                      View{.distance_m = 10.0, .azimuth_deg = 10.0, .roll_deg = -3.0}));

// A wall's edge, a reveal and a frame are several candidates, of which each picture proposes its
// own, and edges are followed in one direction: where that makes a fit begin elsewhere, it ends
// elsewhere, by a small part of its standard deviation.
TEST(EdgeStereoMirrorOfSetBackFrames, MirrorsTheEstimateNearlyAlwaysExactly) {
  const StereoCalibration rig = PaperRig();
  int exact = 0;
  for (const View& view :
       {View{.distance_m = 2.5, .azimuth_deg = 10.0}, View{.distance_m = 3.0, .azimuth_deg = 40.0},
        View{.distance_m = 4.0, .azimuth_deg = -25.0, .roll_deg = 3.0},
        View{.distance_m = 6.0, .azimuth_deg = 1.0},
        View{.distance_m = 7.0, .azimuth_deg = 30.0}}) {
    for (const double setback_m : {0.05, 0.1, 0.2}) {
      const ExactFrame frame{
          .X_LO = WindowSeenFrom(view), .opening_dn = 25.0, .setback_m = setback_m};
      const StereoObservation seen =
          WithNoise(ExactPicture(rig.left, Pose(), frame), ExactPicture(rig.right, rig.X_RL, frame),
                    kMirrorNoise_dn, RandomStream(3));
      const WindowEstimate one = EstimateIn(DetectBeside(rig, seen));
      const double difference_m =
          LargestDifference(one, EstimateIn(DetectBeside(rig, Mirrored(seen))));
      EXPECT_LT(difference_m, 0.1 * std::sqrt(one.covariance_C->trace()))
          << view.distance_m << " m, " << setback_m << " m back";
      if (difference_m < kRounding_m) ++exact;
    }
  }
  EXPECT_GE(exact, 12);  // Of 15.
}

}  // namespace
}  // namespace fenestra
