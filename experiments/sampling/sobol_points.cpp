#include "experiments/sampling/sobol_points.h"

#include <fmt/format.h>

#include <openturns/SobolSequence.hxx>

#include "core/system/check.h"

namespace fenestra {
namespace {

constexpr int kDigits = 32;

}  // namespace

Eigen::MatrixXd SobolPoints(int count, int dimensions) {
  FENESTRA_CHECK(dimensions >= 1 && dimensions <= kMostSobolDimensions,
                 fmt::format("{} dimensions", dimensions));
  FENESTRA_CHECK(count >= 0, fmt::format("{} points", count));
  Eigen::MatrixXd points(count, dimensions);
  // OpenTURNS leaves out the origin, without which no set of 2^m points is a net.
  if (count > 0) points.row(0).setZero();
  OT::SobolSequence sequence(static_cast<OT::UnsignedInteger>(dimensions));
  for (Eigen::Index i = 1; i < count; ++i) {
    const OT::Point point = sequence.generate();
    for (Eigen::Index d = 0; d < dimensions; ++d) {
      points(i, d) = point[static_cast<OT::UnsignedInteger>(d)];
    }
  }
  return points;
}

double OwenScrambled(double coordinate, const RandomStream& coins, double tail) {
  FENESTRA_CHECK(coordinate >= 0.0 && coordinate < 1.0, fmt::format("{}", coordinate));
  const auto digits = static_cast<uint64_t>(coordinate * 0x1p32);
  uint64_t scrambled = 0;
  for (int k = 0; k < kDigits; ++k) {
    // A 1 before the digits so far tells "0" from "00".
    const uint64_t node = uint64_t{1} << k | digits >> (kDigits - k);
    const uint64_t digit = digits >> (kDigits - 1 - k) & 1;
    scrambled = scrambled << 1 | (digit ^ (coins.Uniform(node) < 0.5 ? 0 : 1));
  }
  return (static_cast<double>(scrambled) + tail) * 0x1p-32;
}

}  // namespace fenestra
