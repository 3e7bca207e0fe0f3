// What the paper's pipelines get wrong by themselves: noise, distortion and tolerances are off, and
// the calibration is the true one.

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/study_file/study_reader.h"
#include "experiments/trial/cell_runner.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

struct Error {
  double distance_m;
  Eigen::Vector3d error_C;
};

// The centroid error of each trial of the built-in study `ideal`'s settings; fails on a miss.
std::vector<Error> ErrorsOf(const std::string& sensor) {
  const std::string text =
      "name: ideal\n"
      "repetitions: 3\n"
      "sensors: [" +
      sensor +
      "]\n"
      "factors:\n"
      "  distance_m: [1.8, 2.6, 3.4]\n"
      "  azimuth_deg: {uniform: [-5, 5]}\n"
      "  roll_deg: {uniform: [-2, 2]}\n" +
      (sensor == "stereo" ? "  stereo_noise: false\n"
                            "  stereo_k1: 0\n"
                            "  stereo_k2: 0\n"
                            "  stereo_p1: 0\n"
                            "  stereo_p2: 0\n"
                            "  stereo_fixed_pattern: false\n"
                            "  stereo_as_designed: true\n"
                            "  stereo_calibration: exact\n"
                          : "  rgbd_calibration: exact\n"
                            "  rgbd_fixed_disparity_noise_px: 0\n"
                            "  rgbd_temporal_disparity_noise_px: 0\n"
                            "  rgbd_color_noise: false\n"
                            "  rgbd_color_fixed_pattern: false\n"
                            "  frame_reflectance_830nm: 0.8\n");
  const Study study = ReadStudy(YamlReader::FromText(text, "ideal.yaml"), Detectors());
  std::vector<Error> errors;
  for (const Cell& cell : Cells(study)) {
    const CellRunner runner(study, cell);
    for (int trial = 0; trial < cell.repetitions; ++trial) {
      const SimulatedTrial simulated = runner.Simulate(trial);
      const Score score = runner.Try(0, simulated, false).record.score;
      EXPECT_EQ(score.outcome, Outcome::kHit) << score.detail;
      if (const auto error = score.CentroidError_C()) {
        errors.push_back({simulated.trial.settings.viewpoint.distance_m, *error});
      }
    }
  }
  return errors;
}

TEST(IdealSensorsTest, StereoErrorIsThatOfBlockMatching) {
  const double f_px = 4e-3 / 6e-6;
  for (const auto& [distance_m, error_C] : ErrorsOf("stereo")) {
    // Depth: cv::StereoBM resolves 1/16 px and its parabola is biased by up to 0.1 px (Point Grey's
    // figures for SAD windows of 11 to 15 px); all sides of the frame may share the bias.
    const double disparity_error_px = 1.0 / 16.0 + 0.1;
    EXPECT_LT(std::abs(error_C.z()), disparity_error_px * distance_m * distance_m / (f_px * 0.35))
        << distance_m;
    // Across: the contour follows whole pixels, and the window's reach beyond a corner depends on
    // where the corner lies in its pixel: two pixels.
    EXPECT_LT(error_C.head<2>().norm(), 2.0 * distance_m / f_px) << distance_m;
  }
}

TEST(IdealSensorsTest, RgbdErrorIsThatOfQuantisedDepthAndOfKeyPointsOnWholePixels) {
  for (const auto& [distance_m, error_C] : ErrorsOf("rgbd")) {
    // Depth: the frame's depths are right to half a step of 1/8 px; a frame within one step shares
    // the rounding.
    const double step_m = 0.125 * distance_m * distance_m / (0.075 * 2.0 * 285.63);
    EXPECT_LT(std::abs(error_C.z()), 0.5 * step_m + 0.001) << distance_m;
    // Across: four key points, each on a pixel of the 320-wide range image and up to a few pixels
    // away from its corner, mostly inwards; the crossing of the diagonals keeps what is not
    // symmetric. Two pixels.
    EXPECT_LT(error_C.head<2>().norm(), 2.0 * distance_m / 265.6) << distance_m;
  }
}

}  // namespace
}  // namespace fenestra
