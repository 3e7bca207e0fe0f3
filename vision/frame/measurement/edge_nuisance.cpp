#include "vision/frame/measurement/edge_nuisance.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Shared = BySharedNuisance;
using SharedMatrix = Eigen::Matrix<double, EdgeNuisance::kShared, EdgeNuisance::kShared>;

constexpr double kLeastVariance = 1.0 / 12.0;  // Variance of rounding to whole grey values.
constexpr double kLeastExcess = 1e-3;          // Avoids zero for images without noise.
constexpr double kSmallestBlur_px = 0.25;
constexpr double kLargestBlur_px = 1.5;
constexpr double kLargestSlope = 0.05;
constexpr double kLargestBlurChange_px = 0.15;
// Standard deviations of the prior of lenses and walls, which matter where an edge does not
// determine the parameters.
constexpr double kBlurSigma_px = 0.2;
constexpr double kBlurChangeSigma_px = 0.03;
// Uncertainty of the vignetting's slope, because of lens barrels and uneven light.
constexpr double kFalloffSigma = 0.0002;
constexpr double kLeastSlopeSigma = 0.0001;  // Effect of stray light, as a share of the step.
constexpr double kTail = 0.5;                // Least sigma of a slope, as a share of its departure.
// If the residuals of farther pixels are larger by this factor, something else begins there.
constexpr double kUneven = 1.3;

// Weighted mean of the strips' steps.
class MeanRise {
 public:
  // `own` is the inverse of the information on a strip's unknowns.
  void Add(const StepFit& fit, const Matrix3d& own, double excess) {
    const double variance = excess * own(1, 1) + std::pow(kRiseSpread * fit.rise_dn, 2);
    sum_ += fit.rise_dn / variance;
    weight_ += 1.0 / variance;
    edge_by_rise_ += own(2, 1) / own(1, 1);
    ++count_;
  }
  double Value() const { return sum_ / weight_; }
  // Variance of the mean edge because of the uncertainty of the mean step.
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
  void Put(Brighter brighter, EdgeNuisance& nuisance) const {
    if (std::min(counts_[0], counts_[1]) < 20.0) return;
    const double inside = std::max(kLeastVariance, squares_[0] / counts_[0]);
    const double outside = std::max(kLeastVariance, squares_[1] / counts_[1]);
    nuisance.dark_variance = brighter == Brighter::kOutside ? inside : outside;
    nuisance.bright_variance = brighter == Brighter::kOutside ? outside : inside;
  }

 private:
  std::array<double, 2> squares_ = {};
  std::array<double, 2> counts_ = {};
};

// Residuals near the edge and farther from it.
class Evenness {
 public:
  explicit Evenness(double reach_px) : reach_px_(reach_px) {}
  void Add(const StripPixel& pixel, double square) {
    const size_t i = std::abs(pixel.s_px) > reach_px_ ? 1 : 0;
    squares_[i] += square;
    counts_[i] += 1.0;
  }
  bool Holds() const { return squares_[1] * counts_[0] <= kUneven * squares_[0] * counts_[1]; }

 private:
  double reach_px_;
  std::array<double, 2> squares_ = {};
  std::array<double, 2> counts_ = {};
};

// Prior of blur and slopes.
struct Expected {
  Shared mean = EdgeNuisance{}.shared;
  Shared sigma;
};

Expected ExpectedOf(const std::vector<StepFit>& fits, double falloff, double black_dn) {
  double base_dn = 0.0;
  double rise_dn = 0.0;
  for (const StepFit& fit : fits) {
    base_dn += fit.base_dn / static_cast<double>(fits.size());
    rise_dn += fit.rise_dn / static_cast<double>(fits.size());
  }
  const double outside = std::max(0.0, base_dn + rise_dn - black_dn) / rise_dn;
  const double inside = std::max(0.0, base_dn - black_dn) / rise_dn;
  Expected expected;
  expected.mean[3] = falloff * outside;
  expected.mean[4] = falloff * inside;
  expected.sigma << kBlurSigma_px, kBlurChangeSigma_px, kBlurChangeSigma_px,
      std::hypot(kFalloffSigma * outside, kLeastSlopeSigma),
      std::hypot(kFalloffSigma * inside, kLeastSlopeSigma);
  return expected;
}

// Normal equations of blur and slopes, with the strips' own unknowns eliminated.
class SharedEquations {
 public:
  SharedEquations(const StepModel& model, const Shared& now, const Expected& expected)
      : model_(model) {
    const Shared off = expected.mean - now;
    Shared sigma = expected.sigma;
    for (const int slope : {3, 4})
      sigma[slope] = std::max(sigma[slope], kTail * std::abs(off[slope]));
    information_ = SharedMatrix(sigma.cwiseAbs2().cwiseInverse().asDiagonal());
    gradient_ = information_ * off;
  }
  // Returns the inverse of the information on the strip's own unknowns.
  Matrix3d Add(const EdgeStrip& strip, const StepFit& fit, double excess, SideVariances& variances,
               Evenness& evenness) {
    Matrix3d own = model_.PriorInformation(strip);
    Vector3d own_gradient = Vector3d::Zero();
    Matrix3d mixed = Matrix3d::Zero();
    Matrix3d shape = Matrix3d::Zero();
    Vector3d shape_gradient = Vector3d::Zero();
    for (const StripPixel& pixel : strip.pixels) {
      const StepValue value = model_.At(fit, strip.share, pixel);
      if (!value.counts) continue;
      const double residual = pixel.grey_dn - value.grey_dn;
      own.noalias() += value.weight * value.by_own * value.by_own.transpose();
      own_gradient += value.weight * residual * value.by_own;
      mixed.noalias() += value.weight * value.by_own * value.by_shape.transpose();
      shape.noalias() += value.weight * value.by_shape * value.by_shape.transpose();
      shape_gradient += value.weight * residual * value.by_shape;
      variances.Add(value, residual);
      evenness.Add(pixel, value.weight * residual * residual);
    }
    const SharedByShape shared = StepModel::LineariseShared(fit, strip.share);
    Matrix3d inverse = own.inverse();
    const Eigen::Matrix<double, 3, EdgeNuisance::kShared> own_by_shared =
        inverse * mixed * shared.transpose();
    information_ +=
        shared * (shape - mixed.transpose() * inverse * mixed) * shared.transpose() / excess;
    gradient_ += (shared * shape_gradient - own_by_shared.transpose() * own_gradient) / excess;
    edge_by_shared_ -= own_by_shared.row(2).transpose();
    ++count_;
    return inverse;
  }
  Shared Step() const { return information_.ldlt().solve(gradient_); }
  // Variance of the mean edge because of the uncertainty of blur and slopes.
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

NuisanceEstimate EstimateNuisance(const StepModel& model, const std::vector<EdgeStrip>& strips,
                                  const std::vector<StepFit>& fits, const SideFacts& facts,
                                  const SideRequest& request, const EdgeNuisance& nuisance) {
  const double excess = std::max(facts.excess, kLeastExcess);
  SharedEquations equations(model, nuisance.shared,
                            ExpectedOf(fits, facts.falloff, request.vignetting.black_dn));
  SideVariances variances;
  Evenness evenness(request.reach_px);
  MeanRise rise;
  bool full = false;
  for (size_t i = 0; i < strips.size(); ++i) {
    rise.Add(fits[i], equations.Add(strips[i], fits[i], excess, variances, evenness), excess);
    full |= model.PriorInformation(strips[i])(1, 1) > 0.0;
  }
  NuisanceEstimate estimate{.nuisance = nuisance};
  const Shared change = equations.Step();
  if (change.allFinite()) {
    const double c = kLargestBlurChange_px;
    const double b = kLargestSlope;
    const Shared least{kSmallestBlur_px, -c, -c, -b, -b};
    const Shared most{kLargestBlur_px, c, c, b, b};
    estimate.nuisance.shared += change.cwiseMax(-0.2).cwiseMin(0.2);
    estimate.nuisance.shared = estimate.nuisance.shared.cwiseMax(least).cwiseMin(most);
  }
  variances.Put(request.brighter, estimate.nuisance);
  estimate.nuisance.rise_dn = rise.Value();
  estimate.nuisance.is_even = nuisance.is_even && evenness.Holds();
  estimate.common_sigma_px =
      std::sqrt(equations.EdgeVariance() + (full ? rise.EdgeVariance() : 0.0));
  return estimate;
}

}  // namespace fenestra
