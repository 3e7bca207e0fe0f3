#include "vision/frame/blurred_step.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

constexpr double kReach_px = 8.0;
constexpr int kPerPixel = 32;

double Density(double x) {
  return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
}

double Cumulative(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

}  // namespace

BlurredStep::BlurredStep(double sigma_px, const Eigen::Vector2d& normal) {
  const double longer = std::max(std::abs(normal.x()), std::abs(normal.y()));
  const double shorter = std::min(std::abs(normal.x()), std::abs(normal.y()));
  const double h = 0.5 * longer;
  const double sigma = std::sqrt(sigma_px * sigma_px + shorter * shorter / 12.0);
  const auto integral = [sigma](double s) {
    return s * Cumulative(s / sigma) + sigma * Density(s / sigma);
  };
  const int count = static_cast<int>(2.0 * kReach_px * kPerPixel) + 2;
  table_.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double s = i / static_cast<double>(kPerPixel) - kReach_px;
    const double after = (s + h) / sigma;
    const double before = (s - h) / sigma;
    table_.push_back({(integral(s + h) - integral(s - h)) / longer,
                      (Cumulative(after) - Cumulative(before)) / longer,
                      (Density(after) - Density(before)) / longer * (sigma_px / sigma)});
  }
}

BlurredStep::Value BlurredStep::At(double s_px) const {
  const double place = (std::clamp(s_px, -kReach_px, kReach_px) + kReach_px) * kPerPixel;
  const auto i = static_cast<size_t>(place);
  const double share = place - static_cast<double>(i);
  const Value& a = table_[i];
  const Value& b = table_[i + 1];
  return {a.p + share * (b.p - a.p), a.by_s + share * (b.by_s - a.by_s),
          a.by_sigma + share * (b.by_sigma - a.by_sigma)};
}

}  // namespace fenestra
