#include "vision/frame/measurement/step_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSigmas = 4.8;
constexpr int kPerPixel = 32;

struct Gaussian {
  explicit Gaussian(double x)
      : density(std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi)),
        cumulative(0.5 * std::erfc(-x / std::numbers::sqrt2)) {}
  double density;
  double cumulative;
};

constexpr int kIterations = 8;
constexpr double kFullScale_dn = 255.0;

double Along(double share) {
  return 2.0 * share - 1.0;
}

double Bend(double tau) {
  return tau * tau - 1.0 / 3.0;
}

double Sign(const SideRequest& request) {
  return request.brighter == Brighter::kOutside ? 1.0 : -1.0;
}

}  // namespace

BlurredStep::BlurredStep(double sigma_px, const Eigen::Vector2d& normal) {
  const double longer = std::max(std::abs(normal.x()), std::abs(normal.y()));
  const double shorter = std::min(std::abs(normal.x()), std::abs(normal.y()));
  const double h = 0.5 * longer;
  const double sigma = std::sqrt(sigma_px * sigma_px + shorter * shorter / 12.0);
  const double whole = std::sqrt(sigma_px * sigma_px + 1.0 / 12.0);
  reach_px_ = std::ceil(kSigmas * std::max(sigma, whole) + h);
  const int count = static_cast<int>(2.0 * reach_px_ * kPerPixel) + 2;
  table_.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double s = i / static_cast<double>(kPerPixel) - reach_px_;
    const Gaussian after((s + h) / sigma);
    const Gaussian before((s - h) / sigma);
    const double grown = (s + h) * after.cumulative - (s - h) * before.cumulative +
                         sigma * (after.density - before.density);
    const Gaussian ramp(s / whole);
    table_.push_back({.p = grown / longer,
                      .by_s = (after.cumulative - before.cumulative) / longer,
                      .by_sigma = (after.density - before.density) / longer * (sigma_px / sigma),
                      .ramp = s * ramp.cumulative + whole * ramp.density});
  }
}

BlurredStep::Value BlurredStep::At(double s_px) const {
  if (s_px <= -reach_px_) return {.p = 0.0, .by_s = 0.0, .by_sigma = 0.0, .ramp = 0.0};
  if (s_px >= reach_px_) return {.p = 1.0, .by_s = 0.0, .by_sigma = 0.0, .ramp = s_px};
  const double place = (s_px + reach_px_) * kPerPixel;
  const auto i = static_cast<size_t>(place);
  const double share = place - static_cast<double>(i);
  const Value& a = table_[i];
  const Value& b = table_[i + 1];
  return {.p = a.p + share * (b.p - a.p),
          .by_s = a.by_s + share * (b.by_s - a.by_s),
          .by_sigma = a.by_sigma + share * (b.by_sigma - a.by_sigma),
          .ramp = a.ramp + share * (b.ramp - a.ramp)};
}

StepModel::StepModel(const SideRequest& request, const EdgeNuisance& nuisance,
                     const Eigen::Vector2d& normal)
    : request_(request), nuisance_(nuisance), step_(nuisance.blur_px(), normal) {}

StepValue StepModel::At(const StepFit& fit, double share, const StripPixel& pixel) const {
  const double x = pixel.s_px - fit.s0_px;
  const BlurredStep::Value at = step_.At(x);
  const double tau = Along(share);
  StepValue value;
  value.p = at.p;
  value.by_shape = {at.by_sigma, at.ramp, x - at.ramp};  // Since R(x) - R(-x) = x.
  const double shape =
      at.p +
      (nuisance_.blur_change_px() * tau + nuisance_.blur_bend_px() * Bend(tau)) * at.by_sigma +
      nuisance_.slope_outside() * at.ramp + nuisance_.slope_inside() * (x - at.ramp);
  value.grey_dn = fit.base_dn + fit.rise_dn * shape;
  value.by_own = {1.0, shape, -fit.rise_dn * at.by_s};
  const double bright_share = request_.brighter == Brighter::kOutside ? at.p : 1.0 - at.p;
  value.weight = 1.0 / (nuisance_.dark_variance +
                        bright_share * (nuisance_.bright_variance - nuisance_.dark_variance));
  value.counts = pixel.grey_dn < kFullScale_dn || value.grey_dn < kFullScale_dn;
  return value;
}

SharedByShape StepModel::LineariseShared(const StepFit& fit, double share) {
  const double tau = Along(share);
  SharedByShape by_shape = SharedByShape::Zero();
  by_shape.col(0).head<3>() = Vector3d(1.0, tau, Bend(tau));
  by_shape(3, 1) = 1.0;
  by_shape(4, 2) = 1.0;
  return fit.rise_dn * by_shape;
}

std::optional<StepFit> StepModel::Start(const EdgeStrip& strip) const {
  double n = 0.0, p1 = 0.0, p2 = 0.0, y = 0.0, py = 0.0;
  for (const StripPixel& pixel : strip.pixels) {
    const double p = step_.At(pixel.s_px).p;
    n += 1.0;
    p1 += p;
    p2 += p * p;
    y += pixel.grey_dn;
    py += p * pixel.grey_dn;
  }
  const double determinant = n * p2 - p1 * p1;
  if (!(determinant > 0.5)) return std::nullopt;
  StepFit fit;
  fit.base_dn = (p2 * y - p1 * py) / determinant;
  fit.rise_dn = (n * py - p1 * y) / determinant;
  return fit;
}

Matrix3d StepModel::PriorInformation(const EdgeStrip& strip) const {
  Matrix3d information = Matrix3d::Zero();
  if (nuisance_.rise_dn == 0.0) return information;
  const bool full = std::any_of(strip.pixels.begin(), strip.pixels.end(),
                                [](const StripPixel& p) { return p.grey_dn >= kFullScale_dn; });
  if (full) information(1, 1) = 1.0 / std::pow(kRiseSpread * nuisance_.rise_dn, 2);
  return information;
}

std::optional<StepFit> StepModel::Fit(const EdgeStrip& strip) const {
  auto fit = Start(strip);
  const double sign = Sign(request_);
  if (!fit || sign * fit->rise_dn < 0.5 * request_.min_contrast_dn) return std::nullopt;
  const Matrix3d prior = PriorInformation(strip);
  for (int i = 0; i < kIterations; ++i) {
    Matrix3d normal = prior;
    Vector3d gradient = prior * Vector3d(0.0, nuisance_.rise_dn - fit->rise_dn, 0.0);
    double square = 0.0;
    int count = 0;
    for (const StripPixel& pixel : strip.pixels) {
      const StepValue value = At(*fit, strip.share, pixel);
      if (!value.counts) continue;
      const double residual = pixel.grey_dn - value.grey_dn;
      normal.noalias() += value.weight * value.by_own * value.by_own.transpose();
      gradient += value.weight * residual * value.by_own;
      square += value.weight * residual * residual;
      ++count;
    }
    const double determinant = normal.determinant();
    if (count < 6 || !(determinant > 0.0)) return std::nullopt;
    const Matrix3d inverse = normal.inverse();
    Vector3d change = inverse * gradient;
    const double largest_px = 0.7;
    if (std::abs(change[2]) > largest_px) change *= largest_px / std::abs(change[2]);
    fit->base_dn += change[0];
    fit->rise_dn += change[1];
    fit->s0_px += change[2];
    fit->s0_variance = inverse(2, 2);
    fit->mean_square = square / static_cast<double>(count - 3);
    if (std::abs(fit->s0_px) > 0.7 * request_.reach_px) return std::nullopt;
    if (sign * fit->rise_dn < request_.min_contrast_dn) return std::nullopt;
    if (std::abs(change[2]) < 1e-3) break;
  }
  return fit;
}

}  // namespace fenestra
