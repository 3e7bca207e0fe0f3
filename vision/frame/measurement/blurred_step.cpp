#include "vision/frame/measurement/blurred_step.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

constexpr double kSigmas = 4.8;
constexpr int kPerPixel = 32;

struct Gaussian {
  explicit Gaussian(double x)
      : density(std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi)),
        cumulative(0.5 * std::erfc(-x / std::numbers::sqrt2)) {}
  double density;
  double cumulative;
};

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

}  // namespace fenestra
