#include "experiments/statistics/sign_flip.h"

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

constexpr size_t kMostEnumerated = 16;
constexpr size_t kMostResampled = 2000;
constexpr int kSignFlips = 19'999;
constexpr uint64_t kSeed = 1;

// Sums that differ by rounding alone count as equal.
double Slack(double sum_of_magnitudes) {
  return 1e-12 * sum_of_magnitudes;
}

}  // namespace

double SignFlipPValue(std::span<const double> differences) {
  std::vector<double> d;
  double sum = 0.0;
  double magnitudes = 0.0;
  double squares = 0.0;
  for (const double x : differences) {
    if (x == 0.0) continue;
    d.push_back(x);
    sum += x;
    magnitudes += std::abs(x);
    squares += x * x;
  }
  if (d.empty()) return 1.0;
  const double observed = sum - Slack(magnitudes);
  if (d.size() > kMostResampled) {
    return boost::math::cdf(
        boost::math::complement(boost::math::normal(), sum / std::sqrt(squares)));
  }
  if (d.size() <= kMostEnumerated) {
    const uint64_t assignments = uint64_t{1} << d.size();
    uint64_t at_least = 0;
    for (uint64_t signs = 0; signs < assignments; ++signs) {
      double flipped = 0.0;
      for (size_t i = 0; i < d.size(); ++i) flipped += (signs >> i & 1) != 0 ? d[i] : -d[i];
      at_least += flipped >= observed ? 1 : 0;
    }
    return static_cast<double>(at_least) / static_cast<double>(assignments);
  }
  const RandomStream stream(kSeed);
  uint64_t at_least = 1;  // The observed one.
  std::vector<float> uniforms(d.size());
  for (int b = 0; b < kSignFlips; ++b) {
    stream.Child("signs", static_cast<uint64_t>(b)).FillUniforms(uniforms);
    double flipped = 0.0;
    for (size_t i = 0; i < d.size(); ++i) flipped += uniforms[i] < 0.5f ? d[i] : -d[i];
    at_least += flipped >= observed ? 1 : 0;
  }
  return static_cast<double>(at_least) / (kSignFlips + 1.0);
}

}  // namespace fenestra
