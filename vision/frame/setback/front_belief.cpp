#include "vision/frame/setback/front_belief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

constexpr double kDeepestBelieved_m = 0.20;
// A rectangle fitted to sides at several depths may be behind all of them.
constexpr double kNearestBelieved_m = -0.10;
constexpr double kStep_m = 0.002;
constexpr double kFrontSigma_m = 0.004;  // Rounded or chamfered edges.
// A measured edge may be the front or the rear edge of the opening, that of a pane in between, or
// that of the lining behind.
constexpr double kThickest_m = 0.12;
constexpr int kThicknesses = 12;
// Standard deviation of a uniform distribution within a step of the thickness.
const double kWithinStep_m = kThickest_m / kThicknesses / std::sqrt(12.0);
constexpr double kOther = 0.05;
constexpr double kOtherRange_m = 0.4;

double Normal(double off_m, double sigma_m) {
  const double off = off_m / sigma_m;
  return std::exp(-0.5 * off * off) / (sigma_m * std::sqrt(2.0 * std::numbers::pi));
}

double LikelihoodOf(const std::vector<DepthMeasurement>& measurements, double setback_m,
                    double thickness_m) {
  double product = 1.0;
  for (const DepthMeasurement& measurement : measurements) {
    const double off_m =
        measurement.behind_m - setback_m - (measurement.is_in_thickness ? thickness_m : 0.0);
    const double sigma_m = std::hypot(measurement.sigma_m,
                                      measurement.is_in_thickness ? kWithinStep_m : kFrontSigma_m);
    product *= (1.0 - kOther) * Normal(off_m, sigma_m) + kOther / kOtherRange_m;
  }
  return product;
}

// Marginalises over the thickness.
double Likelihood(const std::vector<DepthMeasurement>& measurements, double setback_m) {
  double sum = 0.0;
  for (int i = 0; i < kThicknesses; ++i) {
    sum += LikelihoodOf(measurements, setback_m, kThickest_m * (i + 0.5) / kThicknesses);
  }
  return sum / kThicknesses;
}

}  // namespace

SetbackPosterior InferSetback(const std::vector<DepthMeasurement>& measurements,
                              double prior_flush) {
  const double flush = prior_flush * Likelihood(measurements, 0.0);
  double sum = flush;
  double first = 0.0;
  double second = 0.0;
  const double nearest_m = prior_flush > 0.0 ? 0.0 : kNearestBelieved_m;
  const int count = static_cast<int>((kDeepestBelieved_m - nearest_m) / kStep_m);
  for (int i = 0; i < count; ++i) {
    const double setback_m = nearest_m + (i + 0.5) * kStep_m;
    const double weight = (1.0 - prior_flush) / count * Likelihood(measurements, setback_m);
    sum += weight;
    first += weight * setback_m;
    second += weight * setback_m * setback_m;
  }
  const double mean_m = first / sum;
  return {.flush = flush / sum,
          .setback = {mean_m, std::sqrt(std::max(0.0, second / sum - mean_m * mean_m))},
          .root_mean_square_m = std::sqrt(second / sum)};
}

}  // namespace fenestra
