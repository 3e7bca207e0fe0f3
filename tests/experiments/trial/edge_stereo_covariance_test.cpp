// Whether edge-stereo's covariance is what its errors are in rendered pictures, with lens, sensor,
// motion and all their noise, given the true calibration; see docs/stereo.md.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <numeric>

#include "experiments/study_file/study_reader.h"
#include "experiments/trial/cell_runner.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

// Centroid errors in units of their covariances, squared, with the default rig, built anew in each
// trial, or with the factors and options given; fails on a miss.
std::vector<double> NormalisedSquares(const std::string& factors, const std::string& options) {
  const std::string text =
      "name: covariance\n"
      "repetitions: 32\n"
      "independent_cells: true\n"
      "sensors: [stereo]\n"
      "detectors: [{name: edge-stereo, options: {" +
      options +
      "}}]\n"
      "factors:\n"
      "  stereo_calibration: exact\n"
      "  sky_illuminance_lx: 500\n"
      "  distance_m: [2.5, 5]\n"
      "  azimuth_deg: [5, 35]\n"
      "  roll_deg: {uniform: [-4, 4]}\n"
      "  pitch_deg: {uniform: [-2, 2]}\n" +
      factors;
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

// Two-sided 1 % test of the sum of squares, each of mean 3 and of this variance. Sums are taken for
// gamma distributed, as they are for normal errors, whose squares have a variance of 6.
bool IsHonest(double sum, size_t count, double variance) {
  const double n = static_cast<double>(count);
  const double scale = variance / 3.0;
  const boost::math::gamma_distribution<> distribution(3.0 * n / scale, scale);
  return sum > quantile(distribution, 0.005) && sum < quantile(distribution, 0.995);
}

void ExpectHonesty(const std::vector<double>& squares, double variance) {
  ASSERT_EQ(squares.size(), 128u);
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  EXPECT_TRUE(IsHonest(sum, squares.size(), variance)) << sum / 128.0 << " of 3 in the mean";
  // The twins with a fault: covariances of half the size, and of twice.
  EXPECT_FALSE(IsHonest(2.0 * sum, squares.size(), variance));
  EXPECT_FALSE(IsHonest(0.5 * sum, squares.size(), variance));
}

// Displacements by coma are cubic in where the lens is decentred to, and so are rarely large, but
// then very: their squares' variance is 24 in 120 trials with
// other seeds.
TEST(EdgeStereoCovarianceTest, IsHonestForTheDefaultCamera) {
  ExpectHonesty(NormalisedSquares("", ""), 24.0);
}

// What is stated of noise is a fifth too large.
TEST(EdgeStereoCovarianceTest, PromisesNoMoreThanSymmetricLensesAtRestKeep) {
  const std::vector<double> squares = NormalisedSquares(
      "  stereo_corner_coma_px: 0\n"
      "  stereo_hover_speed_m_s: 0\n"
      "  stereo_hover_turn_deg_s: 0\n",
      "edge_shift_px: 0.0004, corner_edge_shift_px: 0.0004");
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  const double most = quantile(boost::math::chi_squared(3.0 * 128.0), 0.99);
  EXPECT_LT(sum, most) << sum / 128.0 << " of 3 in the mean";
  EXPECT_GT(2.0 * sum, most);  // The twin.
}

}  // namespace
}  // namespace fenestra
