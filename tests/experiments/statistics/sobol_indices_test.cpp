#include "experiments/statistics/sobol_indices.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "experiments/sampling/causes.h"

namespace fenestra {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kCauses = 3;

// y = sin x1 + 7 sin² x2 + 0.1 x3⁴ sin x1, x_i uniform on [-π, π].
// Source: T. Ishigami and T. Homma, ISUMA 1990.
double Ishigami(const Eigen::Vector3d& x) {
  const double s2 = std::sin(x[1]);
  return std::sin(x[0]) + 7.0 * s2 * s2 + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}

struct Shares {
  Eigen::Vector3d first;
  Eigen::Vector3d total;
};

// From its variances D1, D2, D13 in closed form, with a = 7 and b = 0.1.
Shares IshigamiShares() {
  const double d1 = 0.5 * std::pow(1.0 + 0.1 * std::pow(kPi, 4) / 5.0, 2);
  const double d2 = 49.0 / 8.0;
  const double d13 = 0.01 * std::pow(kPi, 8) * (1.0 / 18.0 - 1.0 / 50.0);
  const double d = d1 + d2 + d13;
  return {.first = Eigen::Vector3d(d1, d2, 0.0) / d,
          .total = Eigen::Vector3d(d1 + d13, d2, d13) / d};
}

// Rows of a pick-freeze design by the same places that trials have.
Eigen::MatrixXd Rows(int count, const RandomStream& stream, double offset = 0.0) {
  Eigen::MatrixXd rows(count, kCauses + 2);
  for (int trial = 0; trial < rows.size(); ++trial) {
    const PickFreezePlace place = PickFreezePlace::Of(trial, kCauses);
    const RandomStream row = stream.Child("row", static_cast<uint64_t>(place.row));
    Eigen::Vector3d x;
    for (size_t i = 0; i < kCauses; ++i) {
      const RandomStream draw = place.UsesSecond(i) ? row.Child("second") : row;
      x[static_cast<Eigen::Index>(i)] = kPi * (2.0 * draw.Uniform(i) - 1.0);
    }
    rows(place.row, place.column) = Ishigami(x) + offset;
  }
  return rows;
}

TEST(SobolIndices, AreThoseOfIshigamisFunction) {
  // The standard error of a correlation from 4000 rows is at most 1/√4000 for normal variates and
  // about as much here; six: 0.095.
  const auto indices = SobolIndices(Rows(4000, RandomStream(1)), RandomStream(2));
  const Shares truth = IshigamiShares();
  ASSERT_TRUE(indices.has_value());
  for (size_t i = 0; i < kCauses; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    EXPECT_NEAR((*indices)[i].first, truth.first[axis], 0.095);
    EXPECT_NEAR((*indices)[i].total, truth.total[axis], 0.095);
  }
  // The values that the literature gives: 0.314, 0.442, 0; 0.558, 0.442, 0.244.
  EXPECT_NEAR(truth.first[0], 0.3139, 5e-5);
  EXPECT_NEAR(truth.total[2], 0.2437, 5e-5);
}

// A far-off mean changes nothing but the rounding.
TEST(SobolIndices, DoNotDependOnTheMean) {
  const auto near = SobolIndices(Rows(300, RandomStream(1)), RandomStream(2));
  const auto far = SobolIndices(Rows(300, RandomStream(1), 1e4), RandomStream(2));
  for (size_t i = 0; i < kCauses; ++i) {
    EXPECT_NEAR((*near)[i].first, (*far)[i].first, 1e-8);
    EXPECT_NEAR((*near)[i].total_interval.upper, (*far)[i].total_interval.upper, 1e-8);
  }
}

TEST(SobolIndices, IntervalsCoverAsOftenAsTheySay) {
  constexpr int kRuns = 150;
  const Shares truth = IshigamiShares();
  std::array<int, 2 * kCauses> covered{};
  for (uint64_t run = 0; run < kRuns; ++run) {
    const auto indices = SobolIndices(Rows(200, RandomStream(run)), RandomStream(run + 1000));
    for (size_t i = 0; i < kCauses; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const SobolIndex& index = (*indices)[i];
      covered[i] += index.first_interval.lower <= truth.first[axis] &&
                    truth.first[axis] <= index.first_interval.upper;
      covered[kCauses + i] += index.total_interval.lower <= truth.total[axis] &&
                              truth.total[axis] <= index.total_interval.upper;
    }
  }
  // Of a true coverage of 0.90, the least that is promised, fewer than 122 of 150 occur with
  // probability 4e-4 (normal approximation: 3.4 standard deviations of 3.7 below 135).
  for (const int count : covered) EXPECT_GE(count, 122);
}

TEST(SobolIndices, NeedRowsThatDiffer) {
  EXPECT_FALSE(SobolIndices(Rows(kFewestRows - 1, RandomStream(1)), RandomStream(2)));
  EXPECT_FALSE(SobolIndices(Eigen::MatrixXd::Ones(100, 5), RandomStream(2)));
}

// The twin: of causes that were mixed up the indices are others.
TEST(SobolIndices, TellCausesApart) {
  Eigen::MatrixXd rows = Rows(2000, RandomStream(1));
  rows.col(2).swap(rows.col(4));
  const auto indices = SobolIndices(rows, RandomStream(2));
  EXPECT_GT((*indices)[2].first_interval.lower, 0.15);  // Truth of x3: 0.
}

}  // namespace
}  // namespace fenestra
