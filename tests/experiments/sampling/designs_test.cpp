#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/sampling/trial_sampler.h"
#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

Study StudyWith(const std::string& design, int trials, int seed = 1) {
  return ReadText("name: test\nsensors: [rgbd]\nrepetitions: " + std::to_string(trials) +
                  "\nseed: " + std::to_string(seed) + "\ndesign: " + design + R"(
factors:
  yaw_deg: {uniform: [0, 1]}
  pitch_deg: {uniform: [0, 1]}
  distance_m: [2, 3]
  sky_illuminance_lx: {log_uniform: [10, 10000]}
parts:
  - name: one
  - name: two
    factors: {yaw_deg: {uniform: [0, 10]}}
)");
}

// The numbers in (0, 1) that the trials' yaw, pitch and illuminance were drawn with.
std::vector<std::vector<double>> Ranks(const Study& study, size_t cell = 0) {
  const TrialSampler sampler(study, Cells(study)[cell]);
  const double yaw_range = cell < 2 ? 1.0 : 10.0;
  std::vector<std::vector<double>> ranks(3);
  for (int i = 0; i < study.parts[0].repetitions; ++i) {
    const FactorValues drawn = sampler.Sample(i).drawn;
    ranks[0].push_back(std::get<double>(drawn[0].second) / yaw_range);
    ranks[1].push_back(std::get<double>(drawn[1].second));
    ranks[2].push_back(std::log10(std::get<double>(drawn[2].second) / 10.0) / 3.0);
  }
  return ranks;
}

// How many boxes of an equal division of the unit square hold exactly one point.
int BoxesWithOnePoint(const std::vector<double>& x, const std::vector<double>& y, int columns,
                      int rows) {
  std::vector<int> counts(static_cast<size_t>(columns * rows));
  for (size_t i = 0; i < x.size(); ++i) {
    const auto column = static_cast<size_t>(x[i] * columns);
    const auto row = static_cast<size_t>(y[i] * rows);
    ++counts[column * static_cast<size_t>(rows) + row];
  }
  return static_cast<int>(std::count(counts.begin(), counts.end(), 1));
}

double Spearman(const std::vector<double>& x, const std::vector<double>& y) {
  const auto ranks = [](const std::vector<double>& values) {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> result;
    for (const double v : values) {
      result.push_back(
          static_cast<double>(std::lower_bound(sorted.begin(), sorted.end(), v) - sorted.begin()));
    }
    return result;
  };
  const std::vector<double> a = ranks(x);
  const std::vector<double> b = ranks(y);
  const double n = static_cast<double>(x.size());
  double squares = 0.0;
  for (size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return 1.0 - 6.0 * squares / (n * (n * n - 1.0));
}

// The largest distance from the uniform distribution (Kolmogorov and Smirnov).
double DistanceFromUniform(std::vector<double> u) {
  std::sort(u.begin(), u.end());
  const double n = static_cast<double>(u.size());
  double distance = 0.0;
  for (size_t i = 0; i < u.size(); ++i) {
    const double below = static_cast<double>(i) / n;
    distance = std::max({distance, u[i] - below, below + 1.0 / n - u[i]});
  }
  return distance;
}

// Of a sample of n uniform numbers, passed with probability 2 exp(-2 · 2.4²) = 2e-5.
double LargestDistance(size_t n) {
  return 2.4 / std::sqrt(static_cast<double>(n));
}

const char* const kCorrelated =
    ", correlations: [{between: [yaw_deg, pitch_deg], spearman: 0.8}, "
    "{between: [yaw_deg, sky_illuminance_lx], spearman: -0.5}]}";

const char* const kMethods[] = {"monte_carlo", "latin_hypercube", "sobol"};

TEST(LatinHypercube, EachStratumOfEachFactorHasOneTrial) {
  constexpr int kTrials = 97;
  for (const std::string& design :
       {std::string("latin_hypercube"), std::string("{method: latin_hypercube") + kCorrelated}) {
    for (const auto& ranks : Ranks(StudyWith(design, kTrials))) {
      EXPECT_EQ(BoxesWithOnePoint(ranks, ranks, kTrials, 1), kTrials) << design;
    }
  }
  // The twin: of independent trials a stratum holds exactly one with probability 1/e.
  for (const auto& ranks : Ranks(StudyWith("monte_carlo", kTrials))) {
    EXPECT_LT(BoxesWithOnePoint(ranks, ranks, kTrials, 1), 60);
  }
}

TEST(LatinHypercube, FactorsAreInOrdersOfTheirOwn) {
  const auto ranks = Ranks(StudyWith("latin_hypercube", 2000));
  // 1/√n is the standard deviation of Spearman's ρ of independent factors; six: 2e-9.
  EXPECT_LT(std::abs(Spearman(ranks[0], ranks[1])), 6.0 / std::sqrt(2000.0));
  EXPECT_LT(std::abs(Spearman(ranks[0], ranks[2])), 6.0 / std::sqrt(2000.0));
}

TEST(LatinHypercube, BeyondItsTrialsComesAnotherOne) {
  const Study study = StudyWith("latin_hypercube", 50);
  const Cell cell = Cells(study).front();
  std::vector<double> next;
  std::set<double> all;
  for (int i = 0; i < 100; ++i) {
    const double yaw = std::get<double>(SampleTrial(study, cell, i).drawn[0].second);
    if (i >= 50) next.push_back(yaw);
    all.insert(yaw);
  }
  EXPECT_EQ(BoxesWithOnePoint(next, next, 50, 1), 50);
  EXPECT_EQ(all.size(), 100u);
}

// The first two coordinates of Sobol's sequence are a (0, 2)-sequence: each elementary box of area
// 1/n holds exactly one of the first n = 2^m points, and so it is under Owen's scrambling.
TEST(Sobol, EveryElementaryBoxHasOneTrial) {
  for (int seed = 1; seed <= 5; ++seed) {
    const auto ranks = Ranks(StudyWith("sobol", 64, seed));
    const auto random = Ranks(StudyWith("monte_carlo", 64, seed));
    for (const int columns : {1, 2, 4, 8, 16, 32, 64}) {
      EXPECT_EQ(BoxesWithOnePoint(ranks[0], ranks[1], columns, 64 / columns), 64) << columns;
      EXPECT_LT(BoxesWithOnePoint(random[0], random[1], columns, 64 / columns), 45);
    }
    EXPECT_EQ(BoxesWithOnePoint(ranks[2], ranks[2], 64, 1), 64);
  }
}

TEST(Sobol, MeansComeOutMoreExactly) {
  // Of n = 256 independent trials the mean of x y is off by 0.22/16 (standard deviation of the
  // product of two uniforms: √(1/9 - 1/16)); a scrambled net's error is of order n^(-3/2).
  double squares_sobol = 0.0;
  double squares_random = 0.0;
  for (int seed = 1; seed <= 20; ++seed) {
    const auto error = [seed](const char* design) {
      const auto ranks = Ranks(StudyWith(design, 256, seed));
      double mean = 0.0;
      for (size_t i = 0; i < 256; ++i) mean += ranks[0][i] * ranks[2][i] / 256.0;
      return mean - 0.25;
    };
    squares_sobol += std::pow(error("sobol"), 2);
    squares_random += std::pow(error("monte_carlo"), 2);
  }
  EXPECT_LT(squares_sobol, squares_random / 100.0);
}

TEST(Sobol, AScrambledPointIsUniformAndTwoAreIndependent) {
  const Eigen::MatrixXd points = SobolPoints(4, 1);
  ASSERT_EQ(points(0, 0), 0.0);
  ASSERT_EQ(points(1, 0), 0.5);
  std::vector<double> first;
  std::vector<double> within_half;
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    const RandomStream coins(seed);
    first.push_back(OwenScrambled(points(0, 0), coins, 0.5));
    const double second = OwenScrambled(points(1, 0), coins, 0.5);
    EXPECT_NE(first.back() < 0.5, second < 0.5);  // Still one in each half.
    within_half.push_back(std::fmod(2.0 * second, 1.0));
  }
  EXPECT_LT(DistanceFromUniform(first), LargestDistance(first.size()));
  EXPECT_LT(DistanceFromUniform(within_half), LargestDistance(first.size()));
  std::vector<double> places;
  for (const double u : first) places.push_back(std::fmod(2.0 * u, 1.0));
  EXPECT_LT(std::abs(Spearman(places, within_half)), 6.0 / std::sqrt(2000.0));
}

TEST(Correlations, AreTheRankCorrelationsThatWereAskedFor) {
  constexpr int kTrials = 4000;
  for (const std::string method : kMethods) {
    const auto ranks = Ranks(StudyWith("{method: " + method + kCorrelated, kTrials));
    // Of ρ from n independent pairs the standard deviation is at most 1/√n. Six: 2e-9.
    const double tolerance = 6.0 / std::sqrt(static_cast<double>(kTrials));
    EXPECT_NEAR(Spearman(ranks[0], ranks[1]), 0.8, tolerance) << method;
    EXPECT_NEAR(Spearman(ranks[0], ranks[2]), -0.5, tolerance) << method;
  }
}

TEST(Correlations, LeaveEachFactorsDistributionAlone) {
  constexpr size_t kTrials = 2000;
  for (const std::string method : kMethods) {
    for (const auto& ranks : Ranks(StudyWith("{method: " + method + kCorrelated, kTrials))) {
      EXPECT_LT(DistanceFromUniform(ranks), LargestDistance(kTrials)) << method;
    }
  }
}

TEST(Designs, CellsAndPartsShareTheirRanks) {
  for (const std::string method : kMethods) {
    for (const std::string& design : {method, "{method: " + method + kCorrelated}) {
      const Study study = StudyWith(design, 40);
      const auto here = Ranks(study, 0);
      for (const size_t cell : {1u, 2u, 3u}) {
        const auto there = Ranks(study, cell);
        for (size_t factor = 0; factor < 3; ++factor) {
          for (size_t i = 0; i < 40; ++i) {
            EXPECT_NEAR(here[factor][i], there[factor][i], 1e-14) << design;
          }
        }
      }
    }
  }
}

TEST(Designs, ATrialAloneIsTheTrialAmongOthers) {
  for (const std::string method : {"latin_hypercube", "sobol", "sensitivity"}) {
    const Study study = StudyWith(method, 30);
    const Cell cell = Cells(study)[1];
    const TrialSampler sampler(study, cell);
    for (int i = 29; i >= 0; i -= 7) {
      EXPECT_EQ(sampler.Sample(i).drawn, SampleTrial(study, cell, i).drawn) << method;
    }
  }
}

TEST(Designs, AnotherSeedIsAnotherRandomisation) {
  for (const std::string method : kMethods) {
    EXPECT_NE(Ranks(StudyWith(method, 16, 1)), Ranks(StudyWith(method, 16, 2))) << method;
  }
}

}  // namespace
}  // namespace fenestra
