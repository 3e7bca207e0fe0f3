#include "experiments/sampling/trial_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <openturns/SobolSequence.hxx>

#include "core/system/check.h"
#include "experiments/sampling/causes.h"

namespace fenestra {
namespace {

// Purposes of a factor's random numbers.
enum FactorUse : uint64_t { kPoint = 0, kWithinStratum = 1 };

RandomStream RootOf(const Study& study, const Cell& cell) {
  const RandomStream root(study.seed);
  if (!study.independent_cells) return root;
  return root.Child("cell", static_cast<uint64_t>(cell.index));
}

RandomStream Replicate(const RandomStream& root, int index) {
  return root.Child("replicate", static_cast<uint64_t>(index));
}

// A factor keeps its coordinate in all parts, so that they share their random numbers.
std::vector<std::string> NamesOfDrawnFactors(const Study& study) {
  std::vector<std::string> names;
  for (const StudyPart& part : study.parts) {
    for (const Factor& factor : part.factors) {
      if (!std::holds_alternative<Distribution>(factor.setting)) continue;
      if (std::find(names.begin(), names.end(), factor.name) == names.end()) {
        names.push_back(factor.name);
      }
    }
  }
  return names;
}

GaussianCopula CopulaOf(const Study& study, const Cell& cell) {
  std::vector<std::string> names;
  for (const auto& [name, distribution] : DrawnFactors(study, cell)) names.push_back(name);
  const auto copula = GaussianCopula::Of(names, study.parts[cell.part_index].design.correlations);
  FENESTRA_CHECK(copula.has_value(), "correlations that cannot be");
  return *copula;
}

// The rank of each entry, from 0.
Eigen::VectorXd Ranks(const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> order(static_cast<size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  // By index where two are equal, as the result must not depend on the sorting.
  std::sort(order.begin(), order.end(), [&values](Eigen::Index a, Eigen::Index b) {
    return values[a] != values[b] ? values[a] < values[b] : a < b;
  });
  Eigen::VectorXd ranks(values.size());
  for (size_t rank = 0; rank < order.size(); ++rank) {
    ranks[order[rank]] = static_cast<double>(rank);
  }
  return ranks;
}

constexpr int kDigits = 32;

}  // namespace

TrialStreams SharedStreams(const Study& study, const Cell& cell) {
  const RandomStream first = Replicate(RootOf(study, cell), 0);
  return {.shot = first.Child(kShotSource),
          .rig = first.Child(kRigSource),
          .calibration = first.Child(kCalibrationSource)};
}

TrialSampler::TrialSampler(const Study& study, const Cell& cell)
    : root_(RootOf(study, cell)),
      settings_(cell.settings),
      repetitions_(cell.repetitions),
      method_(study.parts[cell.part_index].design.method),
      causes_(CausesOf(study, cell)),
      copula_(CopulaOf(study, cell)) {
  const std::vector<std::string> names = NamesOfDrawnFactors(study);
  for (const auto& [name, distribution] : DrawnFactors(study, cell)) {
    const auto place = std::find(names.begin(), names.end(), name) - names.begin();
    drawn_.push_back({name, distribution, static_cast<int>(place)});
  }
  const bool in_blocks =
      method_ == DesignMethod::kLatinHypercube || method_ == DesignMethod::kSobol;
  if (in_blocks && !drawn_.empty()) first_block_ = Block(0);
}

RandomStream TrialSampler::StreamFor(const std::string& source, int trial_index) const {
  if (method_ != DesignMethod::kSensitivity) return Replicate(root_, trial_index);
  const PickFreezePlace place = PickFreezePlace::Of(trial_index, causes_.size());
  const RandomStream first = Replicate(root_, place.row);
  for (size_t i = 0; i < causes_.size(); ++i) {
    const std::vector<std::string>& sources = causes_[i].sources;
    if (std::find(sources.begin(), sources.end(), source) == sources.end()) continue;
    return place.UsesSecond(i) ? first.Child("second") : first;
  }
  return first;  // A source without a cause has no effect.
}

RandomStream TrialSampler::FactorStream(size_t factor, int trial_index) const {
  const std::string& name = drawn_[factor].name;
  return StreamFor(name, trial_index).Child("factor:" + name);
}

Eigen::VectorXd TrialSampler::IndependentPoint(int trial_index) const {
  Eigen::VectorXd point(static_cast<Eigen::Index>(drawn_.size()));
  for (size_t j = 0; j < drawn_.size(); ++j) {
    point[static_cast<Eigen::Index>(j)] = FactorStream(j, trial_index).Uniform(kPoint);
  }
  return point;
}

Eigen::MatrixXd TrialSampler::LatinBlock(int block) const {
  const int first = block * repetitions_;
  Eigen::MatrixXd points(repetitions_, static_cast<Eigen::Index>(drawn_.size()));
  for (int i = 0; i < repetitions_; ++i) {
    points.row(i) = copula_.Correlated(IndependentPoint(first + i));
  }
  for (size_t j = 0; j < drawn_.size(); ++j) {
    auto column = points.col(static_cast<Eigen::Index>(j));
    column = Ranks(column);
    for (int i = 0; i < repetitions_; ++i) {
      column[i] = (column[i] + FactorStream(j, first + i).Uniform(kWithinStratum)) / repetitions_;
    }
  }
  return points;
}

Eigen::MatrixXd TrialSampler::SobolBlock(int block) const {
  const int first = block * repetitions_;
  int dimensions = 0;
  for (const DrawnFactor& factor : drawn_) {
    dimensions = std::max(dimensions, factor.sobol_dimension + 1);
  }
  const Eigen::MatrixXd sobol = SobolPoints(repetitions_, dimensions);
  const RandomStream scrambling = root_.Child("scrambling", static_cast<uint64_t>(block));
  Eigen::MatrixXd points(repetitions_, static_cast<Eigen::Index>(drawn_.size()));
  for (size_t j = 0; j < drawn_.size(); ++j) {
    const RandomStream coins = scrambling.Child("factor:" + drawn_[j].name);
    for (int i = 0; i < repetitions_; ++i) {
      points(i, static_cast<Eigen::Index>(j)) =
          OwenScrambled(sobol(i, drawn_[j].sobol_dimension), coins,
                        FactorStream(j, first + i).Uniform(kWithinStratum));
    }
  }
  for (int i = 0; i < repetitions_; ++i) points.row(i) = copula_.Correlated(points.row(i));
  return points;
}

Eigen::MatrixXd TrialSampler::Block(int block) const {
  return method_ == DesignMethod::kSobol ? SobolBlock(block) : LatinBlock(block);
}

Eigen::VectorXd TrialSampler::Point(int trial_index) const {
  if (first_block_.size() == 0) return copula_.Correlated(IndependentPoint(trial_index));
  const int block = trial_index / repetitions_;
  const int row = trial_index % repetitions_;
  if (block == 0) return first_block_.row(row);
  return Block(block).row(row);
}

Trial TrialSampler::Sample(int trial_index) const {
  FENESTRA_CHECK(trial_index >= 0, "a trial's index counts from 0");
  const auto stream = [&](const char* source) {
    return StreamFor(source, trial_index).Child(source);
  };
  Trial trial{.index = trial_index,
              .settings = settings_,
              .drawn = {},
              .streams = {.shot = stream(kShotSource),
                          .rig = stream(kRigSource),
                          .calibration = stream(kCalibrationSource)}};
  const Eigen::VectorXd point = Point(trial_index);
  for (size_t j = 0; j < drawn_.size(); ++j) {
    const double value = Quantile(drawn_[j].distribution, point[static_cast<Eigen::Index>(j)]);
    Factors().Set(trial.settings, drawn_[j].name, value);
    trial.drawn.emplace_back(drawn_[j].name, value);
  }
  return trial;
}

Trial SampleTrial(const Study& study, const Cell& cell, int trial_index) {
  return TrialSampler(study, cell).Sample(trial_index);
}

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
