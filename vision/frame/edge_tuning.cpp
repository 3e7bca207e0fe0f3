#include "vision/frame/edge_tuning.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Shared = Eigen::Matrix<double, EdgeTuning::kShared, 1>;
using SharedMatrix = Eigen::Matrix<double, EdgeTuning::kShared, EdgeTuning::kShared>;

constexpr double kLeastVariance = 1.0 / 12.0;  // Of a grey value that is rounded.
constexpr double kLeastExcess = 1e-3;          // Pictures without noise.
constexpr double kSmallestBlur_px = 0.25;
constexpr double kLargestBlur_px = 1.5;
constexpr double kLargestSlope = 0.05;
constexpr double kLargestBlurChange_px = 0.15;
// What lenses and walls are like where an edge does not tell: standard deviations of a priori laws.
constexpr double kBlurSigma_px = 0.2;
constexpr double kBlurChangeSigma_px = 0.03;
constexpr double kSlopeSigma = 0.002;  // Of the step's height, per pixel; vignetting has 0.001.

// Weighted mean of the strips' steps.
class MeanRise {
 public:
  // own: inverse of the information on a strip's unknowns.
  void Add(const StepFit& fit, const Matrix3d& own, double excess) {
    const double variance = excess * own(1, 1) + std::pow(kRiseSpread * fit.rise_dn, 2);
    sum_ += fit.rise_dn / variance;
    weight_ += 1.0 / variance;
    edge_by_rise_ += own(2, 1) / own(1, 1);
    ++count_;
  }
  double Value() const { return sum_ / weight_; }
  // Of the mean edge, because of what is not known of the mean step.
  double EdgeVariance() const { return std::pow(edge_by_rise_ / count_, 2) / weight_; }

 private:
  double sum_ = 0.0;
  double weight_ = 0.0;
  double edge_by_rise_ = 0.0;
  int count_ = 0;
};

// Variances of the grey values inside and outside.
class SideVariances {
 public:
  void Add(const StepValue& value, double residual) {
    if (value.p > 0.05 && value.p < 0.95) return;
    squares_[value.p > 0.5 ? 1 : 0] += residual * residual;
    counts_[value.p > 0.5 ? 1 : 0] += 1.0;
  }
  void Put(Brighter brighter, EdgeTuning& tuning) const {
    if (std::min(counts_[0], counts_[1]) < 20.0) return;
    const double inside = std::max(kLeastVariance, squares_[0] / counts_[0]);
    const double outside = std::max(kLeastVariance, squares_[1] / counts_[1]);
    tuning.dark_variance = brighter == Brighter::kOutside ? inside : outside;
    tuning.bright_variance = brighter == Brighter::kOutside ? outside : inside;
  }

 private:
  std::array<double, 2> squares_ = {};
  std::array<double, 2> counts_ = {};
};

// Blur and slopes, with the strips' own unknowns eliminated.
class SharedEquations {
 public:
  SharedEquations(const StepModel& model, const Shared& now) : model_(model) {
    Shared sigma;
    sigma << kBlurSigma_px, kBlurChangeSigma_px, kBlurChangeSigma_px, kSlopeSigma, kSlopeSigma;
    information_ = SharedMatrix(sigma.cwiseAbs2().cwiseInverse().asDiagonal());
    gradient_ = information_ * (EdgeTuning{}.shared - now);
  }
  // Returns the inverse of the information on the strip's own unknowns.
  Matrix3d Add(const EdgeStrip& strip, const StepFit& fit, double excess,
               SideVariances& variances) {
    Matrix3d own = model_.PriorInformation(strip);
    Vector3d own_gradient = Vector3d::Zero();
    Eigen::Matrix<double, 3, EdgeTuning::kShared> mixed;
    mixed.setZero();
    SharedMatrix information = SharedMatrix::Zero();
    Shared gradient = Shared::Zero();
    for (const StripPixel& pixel : strip.pixels) {
      const StepValue value = model_.At(fit, strip.share, pixel);
      if (!value.counts) continue;
      const double residual = pixel.grey_dn - value.grey_dn;
      own.noalias() += value.weight * value.by_own * value.by_own.transpose();
      own_gradient += value.weight * residual * value.by_own;
      mixed.noalias() += value.weight * value.by_own * value.by_shared.transpose();
      information.noalias() += value.weight * value.by_shared * value.by_shared.transpose();
      gradient += value.weight * residual * value.by_shared;
      variances.Add(value, residual);
    }
    const Matrix3d inverse = own.inverse();
    const Eigen::Matrix<double, 3, EdgeTuning::kShared> by_shared = inverse * mixed;
    information_ += (information - mixed.transpose() * by_shared) / excess;
    gradient_ += (gradient - by_shared.transpose() * own_gradient) / excess;
    edge_by_shared_ -= by_shared.row(2).transpose();
    ++count_;
    return inverse;
  }
  Shared Step() const { return information_.ldlt().solve(gradient_); }
  // Of the mean edge, because of what is not known of blur and slopes.
  double EdgeVariance() const {
    const Shared mean = edge_by_shared_ / count_;
    return mean.dot(information_.ldlt().solve(mean));
  }

 private:
  const StepModel& model_;
  SharedMatrix information_;
  Shared gradient_;
  Shared edge_by_shared_ = Shared::Zero();
  int count_ = 0;
};

}  // namespace

Learnt Learn(const StepModel& model, const std::vector<EdgeStrip>& strips,
             const std::vector<StepFit>& fits, double excess, const SideRequest& request,
             const EdgeTuning& tuning) {
  excess = std::max(excess, kLeastExcess);
  SharedEquations equations(model, tuning.shared);
  SideVariances variances;
  MeanRise rise;
  bool full = false;
  for (size_t i = 0; i < strips.size(); ++i) {
    rise.Add(fits[i], equations.Add(strips[i], fits[i], excess, variances), excess);
    full |= model.PriorInformation(strips[i])(1, 1) > 0.0;
  }
  Learnt learnt{.tuning = tuning};
  const Shared change = equations.Step();
  if (change.allFinite()) {
    const double c = kLargestBlurChange_px;
    const double b = kLargestSlope;
    const Shared least{kSmallestBlur_px, -c, -c, -b, -b};
    const Shared most{kLargestBlur_px, c, c, b, b};
    learnt.tuning.shared += change.cwiseMax(-0.2).cwiseMin(0.2);
    learnt.tuning.shared = learnt.tuning.shared.cwiseMax(least).cwiseMin(most);
  }
  variances.Put(request.brighter, learnt.tuning);
  learnt.tuning.rise_dn = rise.Value();
  learnt.common_sigma_px = std::sqrt(equations.EdgeVariance() + (full ? rise.EdgeVariance() : 0.0));
  return learnt;
}

}  // namespace fenestra
