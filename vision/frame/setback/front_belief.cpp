#include "vision/frame/setback/front_belief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

constexpr double kDeepestBelieved_m = 0.20;
// A rectangle of sides at several depths may be behind all of them.
constexpr double kNearestBelieved_m = -0.10;
constexpr double kStep_m = 0.002;
constexpr double kFrontSigma_m = 0.004;  // Rounded or chamfered edges.
// What is seen may be the front edge of the opening or the rear one, that of a pane between or of
// the lining behind.
constexpr double kThickest_m = 0.12;
constexpr int kThicknesses = 12;
// Of the evenly spread places within a step.
const double kWithinStep_m = kThickest_m / kThicknesses / std::sqrt(12.0);
constexpr double kOther = 0.05;
constexpr double kOtherRange_m = 0.4;

double Normal(double off_m, double sigma_m) {
  const double off = off_m / sigma_m;
  return std::exp(-0.5 * off * off) / (sigma_m * std::sqrt(2.0 * std::numbers::pi));
}

double LikelihoodOf(const std::vector<DepthSight>& sights, double setback_m, double thickness_m) {
  double product = 1.0;
  for (const DepthSight& sight : sights) {
    const double off_m = sight.behind_m - setback_m - (sight.is_in_thickness ? thickness_m : 0.0);
    const double sigma_m =
        std::hypot(sight.sigma_m, sight.is_in_thickness ? kWithinStep_m : kFrontSigma_m);
    product *= (1.0 - kOther) * Normal(off_m, sigma_m) + kOther / kOtherRange_m;
  }
  return product;
}

// Over what the thickness may be.
double Likelihood(const std::vector<DepthSight>& sights, double setback_m) {
  double sum = 0.0;
  for (int i = 0; i < kThicknesses; ++i) {
    sum += LikelihoodOf(sights, setback_m, kThickest_m * (i + 0.5) / kThicknesses);
  }
  return sum / kThicknesses;
}

}  // namespace

FrontBelief BelieveFront(const std::vector<DepthSight>& sights, double prior_flush) {
  const double flush = prior_flush * Likelihood(sights, 0.0);
  double sum = flush;
  double first = 0.0;
  double second = 0.0;
  const double nearest_m = prior_flush > 0.0 ? 0.0 : kNearestBelieved_m;
  const int count = static_cast<int>((kDeepestBelieved_m - nearest_m) / kStep_m);
  for (int i = 0; i < count; ++i) {
    const double setback_m = nearest_m + (i + 0.5) * kStep_m;
    const double weight = (1.0 - prior_flush) / count * Likelihood(sights, setback_m);
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
