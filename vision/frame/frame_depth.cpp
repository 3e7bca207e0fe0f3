#include "vision/frame/frame_depth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

constexpr double kRebate_m = 0.07;
// A thick frame flush with the wall, or a thin one that stands back: between these nothing tells.
constexpr double kThickest_m = 0.11;
constexpr double kEither_m = 0.05;
// Of inner sides that tell the frame's depth.
constexpr double kKnownRelief_m = 0.02;
// How far frames stand back where nothing tells: windows are set up to 10 cm deep.
constexpr double kUnknownSetback_m = 0.07;
// Before the inner sides are seen, and what they are worth: the frame's front edge, its rear edge
// or what shows in the pane may be what is seen.
constexpr Setback kUsual{.mean_m = 0.06, .sigma_m = 0.05};
constexpr double kInnerSides_m = 0.05;

void MoveBack(FrameFit& fit, const Setback& setback) {
  FrameAdjustment& adjustment = fit.adjustment;
  const Eigen::Vector3d normal = adjustment.frame.R_LO.col(2);
  adjustment.frame.p_LO -= setback.mean_m * normal;
  for (double& relief_m : adjustment.frame.outer_relief_m) relief_m += setback.mean_m;
  adjustment.frame.inner_relief_m += setback.mean_m;
  adjustment.covariance.block<3, 3>(3, 3) +=
      setback.sigma_m * setback.sigma_m * normal * normal.transpose();
}

Setback Both(const Setback& a, const Setback& b) {
  const double at_a = 1.0 / (a.sigma_m * a.sigma_m);
  const double at_b = 1.0 / (b.sigma_m * b.sigma_m);
  return {(at_a * a.mean_m + at_b * b.mean_m) / (at_a + at_b), 1.0 / std::sqrt(at_a + at_b)};
}

// Some sides may be the wall's and some the frame's own: their parallax is not told apart.
void AddParallax(FrameFit& fit, double depth_m) {
  const FrameRectangle& frame = fit.adjustment.frame;
  const double z_m = frame.p_LO.norm();
  for (int axis = 0; axis < 2; ++axis) {
    const double half_m = 0.5 * (axis == 0 ? frame.width_m : frame.height_m);
    const double off_m = depth_m * half_m / (std::numbers::sqrt2 * z_m);
    const Eigen::Vector3d direction = frame.R_LO.col(axis);
    fit.adjustment.covariance.block<3, 3>(3, 3) +=
        off_m * off_m * direction * direction.transpose();
  }
}

}  // namespace

void StandBack(std::span<const CameraView> views, const RevealGrey& grey, FrameFit& fit) {
  const double inner_m = fit.adjustment.frame.inner_relief_m;
  const double sigma_m = std::sqrt(fit.adjustment.covariance(13, 13));
  fit.knows_depth = sigma_m > 0.0 && sigma_m < kKnownRelief_m;
  if (inner_m + 2.0 * sigma_m > -kRebate_m) return;  // A far frame's thickness is but guessed.
  const auto reveal = FindSetback(views, fit.adjustment.frame, grey);
  const Setback inner = Both(kUsual, {kPanes.mean_m - inner_m, std::hypot(sigma_m, kInnerSides_m)});
  const bool agree = reveal && reveal->mean_m > 0.0 &&
                     std::abs(reveal->mean_m - inner.mean_m) < 2.0 * inner.sigma_m;
  const bool either = inner_m > -kThickest_m;
  const Setback setback = agree ? *reveal : either ? Setback{0.0, kEither_m} : inner;
  MoveBack(fit, setback);
  AddParallax(fit, std::max(setback.mean_m, setback.sigma_m));
  fit.knows_depth = true;
}

void SettleDepth(std::span<const CameraView> views, const RevealGrey& grey, FrameFit& fit) {
  const auto setback = fit.is_flat ? FindSetback(views, fit.adjustment.frame, grey) : std::nullopt;
  MoveBack(fit, setback.value_or(Setback{0.0, kUnknownSetback_m}));
  const double depth_m = setback ? std::max(setback->mean_m, setback->sigma_m) : kUnknownSetback_m;
  if (depth_m > 0.0) AddParallax(fit, depth_m);
  fit.knows_depth = setback.has_value();
}

}  // namespace fenestra
