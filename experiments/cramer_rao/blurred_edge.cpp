#include "experiments/cramer_rao/blurred_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

// Narrower would divide by zero; a pixel's area is wider by far.
constexpr double kLeastSigma_px = 0.02;
constexpr double kLeastHalfWidth_px = 1e-4;

// Φ and its first and second integral.
struct Integrals {
  double once;
  double twice;
  double thrice;
};
Integrals IntegralsAt(double x, double sigma) {
  const double t = x / sigma;
  const double cumulative = 0.5 * std::erfc(-t / std::numbers::sqrt2);
  const double density =
      std::exp(-0.5 * t * t) * (0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2);
  return {.once = cumulative,
          .twice = x * cumulative + sigma * density,
          .thrice = 0.5 * ((x * x + sigma * sigma) * cumulative + x * sigma * density)};
}

}  // namespace

BlurredEdge::BlurredEdge(double sigma_px, const Eigen::Vector2d& normal)
    : sigma_(std::max(sigma_px, kLeastSigma_px)),
      a_(std::max(0.5 * std::abs(normal.x()), kLeastHalfWidth_px)),
      b_(std::max(0.5 * std::abs(normal.y()), kLeastHalfWidth_px)) {}

BlurredEdge::Value BlurredEdge::At(double distance_px) const {
  if (distance_px <= -reach_px()) return {0.0, 0.0, 0.0};
  if (distance_px >= reach_px()) return {1.0, 0.0, 0.0};
  Integrals sum{};
  for (const auto& [offset, sign] :
       {std::pair{a_ + b_, 1.0}, {a_ - b_, -1.0}, {b_ - a_, -1.0}, {-a_ - b_, 1.0}}) {
    const Integrals at = IntegralsAt(distance_px + offset, sigma_);
    sum.once += sign * at.once;
    sum.twice += sign * at.twice;
    sum.thrice += sign * at.thrice;
  }
  const double area = 4.0 * a_ * b_;
  return {.share = sum.thrice / area,
          .by_distance = sum.twice / area,
          .by_sigma = sigma_ * sum.once / area};
}

double EdgeBound_px(double contrast, double noise, double blur_sigma_px) {
  return noise / contrast * std::sqrt(2.0 / std::numbers::inv_sqrtpi * blur_sigma_px);
}

}  // namespace fenestra
