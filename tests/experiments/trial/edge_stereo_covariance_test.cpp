// Whether edge-stereo's covariance is what its errors are in rendered pictures, with lens, sensor
// and all their noise, given the true calibration, cameras that stand still and point spreads that
// are even, as it takes them for. Coma and motion are in no covariance of noise: see docs/stereo.md.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <boost/math/distributions/chi_squared.hpp>

#include "experiments/study_file/study_reader.h"
#include "experiments/trial/cell_runner.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

// Centroid errors in units of their covariances, squared; fails on a miss.
std::vector<double> NormalisedSquares() {
  const std::string text =
      "name: covariance\n"
      "repetitions: 8\n"
      "sensors: [stereo]\n"
      "detectors: [edge-stereo]\n"
      "factors:\n"
      "  stereo_calibration: exact\n"
      "  stereo_corner_coma_px: 0\n"
      "  stereo_hover_speed_m_s: 0\n"
      "  stereo_hover_turn_deg_s: 0\n"
      "  sky_illuminance_lx: 500\n"
      "  distance_m: [2.5, 5]\n"
      "  azimuth_deg: [5, 35]\n"
      "  roll_deg: {uniform: [-4, 4]}\n"
      "  pitch_deg: {uniform: [-2, 2]}\n";
  const Study study = ReadStudy(YamlReader::FromText(text, "covariance.yaml"), Detectors());
  std::vector<double> squares;
  for (const Cell& cell : Cells(study)) {
    const CellRunner runner(study, cell);
    for (int trial = 0; trial < cell.repetitions; ++trial) {
      const Score score = runner.Try(0, runner.Simulate(trial), false).record.score;
      const auto error = score.CentroidError_C();
      EXPECT_TRUE(error && score.estimate->covariance_C) << score.detail;
      if (!error || !score.estimate->covariance_C) continue;
      squares.push_back(error->dot(score.estimate->covariance_C->inverse() * *error));
    }
  }
  return squares;
}

// Two-sided 1 % test of the sum, 3 degrees of freedom each.
bool IsHonest(double sum, size_t count) {
  const boost::math::chi_squared distribution(3.0 * static_cast<double>(count));
  return sum > quantile(distribution, 0.005) && sum < quantile(distribution, 0.995);
}

TEST(EdgeStereoCovarianceTest, IsHonestForNoiseInRenderedPictures) {
  const std::vector<double> squares = NormalisedSquares();
  ASSERT_EQ(squares.size(), 32u);
  double sum = 0.0;
  for (const double square : squares) sum += square;
  EXPECT_TRUE(IsHonest(sum, squares.size())) << sum / 32.0 << " of 3 in the mean";
  // The twin with a fault: covariances of half the size.
  EXPECT_FALSE(IsHonest(2.0 * sum, squares.size()));
}

}  // namespace
}  // namespace fenestra
