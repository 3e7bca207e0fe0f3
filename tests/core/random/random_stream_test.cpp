#include "core/random/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <set>
#include <vector>

namespace fenestra {
namespace {

// Kolmogorov's statistic times √n; exceeds 1.95 with probability 0.1 % for the right distribution.
template <typename Cdf>
double KolmogorovStatistic(std::vector<double> sample, Cdf cdf) {
  std::sort(sample.begin(), sample.end());
  const double n = static_cast<double>(sample.size());
  double largest = 0.0;
  for (size_t i = 0; i < sample.size(); ++i) {
    const double p = cdf(sample[i]);
    largest =
        std::max({largest, (static_cast<double>(i) + 1.0) / n - p, p - static_cast<double>(i) / n});
  }
  return largest * std::sqrt(n);
}
constexpr double kOnePerMille = 1.95;

double NormalCdf(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

constexpr uint64_t kSamples = 20000;

TEST(RandomStreamTest, SameArgumentsGiveTheSameNumberInAnyOrder) {
  const RandomStream a = RandomStream(7).Child("noise", 3);
  const RandomStream b = RandomStream(7).Child("noise", 3);
  const double late = a.Uniform(1000);
  EXPECT_NE(late, a.Uniform(0));
  EXPECT_EQ(b.Uniform(0), a.Uniform(0));
  EXPECT_EQ(b.Uniform(1000), late);
}

TEST(RandomStreamTest, PathsDifferInSeedPurposeIndexAndOrder) {
  const std::set<uint64_t> keys = {
      RandomStream(1).Child("a", 0).key(),         RandomStream(2).Child("a", 0).key(),
      RandomStream(1).Child("b", 0).key(),         RandomStream(1).Child("a", 1).key(),
      RandomStream(1).Child("a").Child("b").key(), RandomStream(1).Child("b").Child("a").key()};
  EXPECT_EQ(keys.size(), 6u);
}

TEST(RandomStreamTest, NumbersAreTheSameOnEveryMachine) {
  // Published test vector of Philox4x32-10 is checked by Random123 itself; these values pin our
  // use of it, so that recorded studies can be replayed by later versions.
  EXPECT_EQ(RandomStream(2013).Child("replicate", 5).key(), 6123563874410699465ull);
}

TEST(RandomStreamTest, UniformsAreUniform) {
  const RandomStream stream(11);
  std::vector<double> sample;
  for (uint64_t i = 0; i < kSamples; ++i) sample.push_back(stream.Uniform(i));
  EXPECT_LT(KolmogorovStatistic(sample, [](double x) { return x; }), kOnePerMille);
  // The twin: a bias of 2 % is rejected.
  for (double& x : sample) x = std::pow(x, 1.05);
  EXPECT_GT(KolmogorovStatistic(sample, [](double x) { return x; }), kOnePerMille);
}

TEST(RandomStreamTest, NormalsAreNormal) {
  const RandomStream stream(12);
  std::vector<double> sample;
  for (uint64_t i = 0; i < kSamples; ++i) sample.push_back(stream.Normal(i));
  EXPECT_LT(KolmogorovStatistic(sample, NormalCdf), kOnePerMille);
  for (double& x : sample) x *= 1.05;
  EXPECT_GT(KolmogorovStatistic(sample, NormalCdf), kOnePerMille);
}

TEST(RandomStreamTest, FilledNormalsAreNormalAndIndependentOfTheLength) {
  std::vector<float> filled(kSamples);
  RandomStream(13).FillNormals(filled);
  const std::vector<double> sample(filled.begin(), filled.end());
  EXPECT_LT(KolmogorovStatistic(sample, NormalCdf), kOnePerMille);

  std::vector<float> shorter(1001);
  RandomStream(13).FillNormals(shorter);
  EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), filled.begin()));
}

TEST(RandomStreamTest, FilledUniformsAreUniform) {
  std::vector<float> filled(kSamples);
  RandomStream(14).FillUniforms(filled);
  EXPECT_LT(KolmogorovStatistic({filled.begin(), filled.end()}, [](double x) { return x; }),
            kOnePerMille);
  EXPECT_GT(*std::min_element(filled.begin(), filled.end()), 0.0f);
  EXPECT_LT(*std::max_element(filled.begin(), filled.end()), 1.0f);
}

}  // namespace
}  // namespace fenestra
