#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/random/random_stream.h"
#include "experiments/sampling/gaussian_copula.h"
#include "experiments/study/study.h"

namespace fenestra {

/// All randomness of a trial besides its drawn factors. Detectors share it.
struct TrialStreams {
  RandomStream shot;         ///< Noise of the images.
  RandomStream rig;          ///< Deviations of the rig as built from its design.
  RandomStream calibration;  ///< Errors of the rig's calibration.
};

/// One point of a study, ready to be simulated.
struct Trial {
  int index;  ///< In its cell, from 0.
  TrialSettings settings;
  FactorValues drawn;  ///< The values that the factors' distributions gave in this trial.
  TrialStreams streams;
};

/// The streams of the rig that all trials share, where a study does not draw one for each.
TrialStreams SharedStreams(const Study& study, const Cell& cell);

/// Draws the trials of one cell. A trial is a function of the study, the cell and its index alone,
/// and of the cell only by its settings, its repetitions and, where the study asks for independent
/// cells, its index; so trials can be made in any order, by any thread, alone and again.
///
/// A factor's value is the quantile of its distribution at a number in (0, 1), which depends on the
/// trial's index and the factor's name: cells that draw the same factor from different
/// distributions are compared at the same ranks. With u_ij for trial i and factor j:
///
///     monte_carlo      u_ij independent and uniform, then correlated (GaussianCopula)
///     latin_hypercube  (rank of the above among the n of the cell + jitter) / n
///     sobol            Sobol points, scrambled (OwenScrambled), then correlated
///     sensitivity      as monte_carlo, but equal in all trials of a row that do not exchange the
///                      cause the factor belongs to (PickFreezePlace); so are the streams
///
/// The ranks of correlated numbers keep their correlation, and each margin has one trial in each of
/// n strata: M. Stein, "Large sample properties of simulations using Latin hypercube sampling",
/// Technometrics 29, 1987. n is the cell's repetitions; a trial beyond them is the first of another
/// n with randomness of its own.
class TrialSampler {
 public:
  TrialSampler(const Study& study, const Cell& cell);

  Trial Sample(int trial_index) const;

 private:
  struct DrawnFactor {
    std::string name;
    Distribution distribution;
    int sobol_dimension;
  };

  RandomStream StreamFor(const std::string& source, int trial_index) const;
  RandomStream FactorStream(size_t factor, int trial_index) const;
  Eigen::VectorXd IndependentPoint(int trial_index) const;
  Eigen::VectorXd Point(int trial_index) const;
  Eigen::MatrixXd Block(int block) const;
  Eigen::MatrixXd LatinBlock(int block) const;
  Eigen::MatrixXd SobolBlock(int block) const;

  RandomStream root_;
  TrialSettings settings_;
  int repetitions_;
  DesignMethod method_;
  std::vector<Cause> causes_;
  std::vector<DrawnFactor> drawn_;
  GaussianCopula copula_;
  Eigen::MatrixXd first_block_;  ///< A trial a row; empty with designs whose trials stand alone.
};

/// One trial. `trial_index` may exceed the cell's repetitions. For many, keep a TrialSampler.
Trial SampleTrial(const Study& study, const Cell& cell, int trial_index);

/// OpenTURNS has direction numbers for so many dimensions.
inline constexpr int kMostSobolDimensions = 1111;

/// The first `count` points of the Sobol sequence, the origin among them, one a row; multiples of
/// 2⁻³². Every 2^m points from the start are a digital net, in Gray code order.
/// Direction numbers: S. Joe and F. Y. Kuo, "Constructing Sobol sequences with better
/// two-dimensional projections", SIAM J. Sci. Comput. 30, 2008, from OpenTURNS.
/// Domain: 1 ≤ dimensions ≤ kMostSobolDimensions, 0 ≤ count ≤ 2³².
Eigen::MatrixXd SobolPoints(int count, int dimensions);

/// Owen's nested uniform scrambling of one coordinate in [0, 1): each of its first 32 binary digits
/// is flipped or not by a coin that depends on the digits before it; what follows is `tail`, in
/// (0, 1). All points whose coordinate has the same stream keep their equidistribution, each is
/// uniform on (0, 1) for itself.
/// Source: A. B. Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995.
double OwenScrambled(double coordinate, const RandomStream& coins, double tail);

}  // namespace fenestra
