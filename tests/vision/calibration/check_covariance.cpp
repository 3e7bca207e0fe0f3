// Calibrates simulated rigs with rendered pictures of boards and tests whether the errors are as
// large as the covariances say. Takes about 5 s a rig; not part of the test suite.
//   check_calibration_covariance [RIGS [SEED]]
// Exits with 1 if the sum of the normalised squared errors is not χ² (two-sided, 1 %).

#include <fmt/format.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cstdlib>

#include "experiments/trial/calibrated_rig.h"
#include "tests/vision/calibration/normalised_error.h"

int main(int argc, char** argv) {
  using namespace fenestra;
  const int rigs = argc > 1 ? std::atoi(argv[1]) : 100;
  const auto seed = static_cast<uint64_t>(argc > 2 ? std::atoi(argv[2]) : 1);
  BoardSessionOptions drawn;
  drawn.tolerances = kAsDrawn;
  double sum = 0.0;
  PairVector squares = PairVector::Zero();
  PairVector deviations = PairVector::Zero();
  for (int i = 0; i < rigs; ++i) {
    const RandomStream stream = RandomStream(seed).Child("rig", static_cast<uint64_t>(i));
    const StereoRig rig({}, stream.Child("rig"));
    const StereoCalibrationResult result =
        CalibrateWithBoards(rig, drawn, {}, stream.Child("boards"));
    const PairVector error = PairError(result.calibration, rig.cameras());
    const PairVector deviation = result.covariance.diagonal().cwiseSqrt();
    sum += testing::NormalisedSquaredError(error, result.covariance);
    squares += error.cwiseAbs2();
    deviations += deviation;
  }
  fmt::print("{:24} {:>12} {:>12}\n", "parameter", "RMS error", "mean sigma");
  for (int i = 0; i < kPairParameters; ++i) {
    if (!(deviations[i] > 0.0)) continue;
    fmt::print("{:24} {:12.4g} {:12.4g}\n", PairParameterNames()[static_cast<size_t>(i)],
               std::sqrt(squares[i] / rigs), deviations[i] / rigs);
  }
  const int freedom = rigs * testing::kFreeParameters;
  const boost::math::chi_squared law(freedom);
  const double low = boost::math::quantile(law, 0.005);
  const double high = boost::math::quantile(law, 0.995);
  const bool holds = low < sum && sum < high;
  fmt::print(
      "normalised squared error: {:.2f} of {} in the mean over {} rigs; {:.0f} in [{:.0f}, "
      "{:.0f}]: {}\n",
      sum / rigs, testing::kFreeParameters, rigs, sum, low, high,
      holds ? "holds" : "does not hold");
  return holds ? 0 : 1;
}
