#include "vision/frame/setback/frame_setback.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "vision/frame/measurement/frame_border.h"
#include "vision/frame/measurement/side_sampling.h"

namespace fenestra {
namespace {

constexpr double kShallowest_m = 0.05;
constexpr double kDeepest_m = 0.30;
constexpr double kNarrowest_px =
    4.5;  // Narrowest reveal that can be separated from the blur beside it.
constexpr double kClear_px = 2.0;      // Distance from an edge beyond its blur.
const double kDarker = std::log(1.5);  // Step from reveal to frame; paints differ by more.

struct SideView {
  double inwards_m;   // h, from the side to the camera, along the front.
  double distance_m;  // z.
  double pixel_m;     // Size of a pixel on the rectangle, across the side.
  double Inset(double depth_m) const { return inwards_m * depth_m / (distance_m + depth_m); }
};

SideView Look(const CameraView& view, const FrameRectangle& frame, Side side) {
  const Eigen::Vector3d p_OC =
      frame.R_LO.transpose() * (view.X_CL.inverse().translation() - frame.p_LO);
  const double across = side == Side::kLeft ? -p_OC.x() : side == Side::kRight ? p_OC.x() : 0.0;
  const double up = side == Side::kTop ? p_OC.y() : side == Side::kBottom ? -p_OC.y() : 0.0;
  const bool upright = side == Side::kLeft || side == Side::kRight;
  const double half_m = 0.5 * (upright ? frame.width_m : frame.height_m);
  return {.inwards_m = half_m - across - up,
          .distance_m = p_OC.z(),
          .pixel_m = PixelAcross(view, frame, side)};
}

enum class Evidence { kNothing, kNoReveal, kReveal };

// Mean grey value above black at this inset.
std::optional<double> LightAt(const CameraView& view, FrameRectangle frame, Side side,
                              double inset_m, double black_dn) {
  frame.border_m = inset_m;
  frame.inner_relief_m = 0.0;
  const auto grey = MeanAlong(view, frame, side);
  if (!grey) return std::nullopt;
  return std::max(1.0, *grey - black_dn);
}

// Natural logarithm of the ratio, or 0 if noise alone may explain the difference.
double LogRatio(double bright, double dark, double min_contrast_dn) {
  return std::abs(bright - dark) < min_contrast_dn ? 0.0 : std::log(bright / dark);
}

Evidence LookForReveal(const CameraView& view, const FrameRectangle& frame, Side side,
                       const RevealGrey& grey) {
  const SideView look = Look(view, frame, side);
  if (look.inwards_m <= 0.0 || look.distance_m <= 0.0 || look.pixel_m <= 0.0) {
    return Evidence::kNothing;
  }
  const double step_m = 0.5 * look.pixel_m;
  const double most_m =
      std::min(look.Inset(kDeepest_m), 0.3 * std::min(frame.width_m, frame.height_m));
  const double clear_m = kClear_px * look.pixel_m;
  double t = 2.0 * clear_m;
  for (; t < most_m; t += step_m) {
    const auto before = LightAt(view, frame, side, t - clear_m, grey.black_dn);
    const auto after = LightAt(view, frame, side, t + clear_m, grey.black_dn);
    if (!before || !after) continue;
    const double darker = LogRatio(*before, *after, grey.min_contrast_dn);
    if (darker > kDarker) return Evidence::kReveal;
    if (darker < -kDarker) break;  // The opening: here the frame ends.
  }
  const bool would_show = look.Inset(kShallowest_m) > kNarrowest_px * look.pixel_m &&
                          t > look.Inset(kShallowest_m) + clear_m;
  return would_show ? Evidence::kNoReveal : Evidence::kNothing;
}

constexpr double kDeepestBelieved_m = 0.20;
// A rectangle fitted to sides at several depths may be behind all of them.
constexpr double kNearestBelieved_m = -0.10;
constexpr double kStep_m = 0.002;
constexpr double kFrontSigma_m = 0.004;  // Rounded or chamfered edges.
// A measured edge may be the front or the rear edge of the opening, that of a pane in between, or
// that of the lining behind.
constexpr double kThickest_m = 0.12;
constexpr int kThicknesses = 12;
// Standard deviation of a uniform distribution within a step of the thickness.
const double kWithinStep_m = kThickest_m / kThicknesses / std::sqrt(12.0);
constexpr double kOther = 0.05;
constexpr double kOtherRange_m = 0.4;

double Normal(double off_m, double sigma_m) {
  const double off = off_m / sigma_m;
  return std::exp(-0.5 * off * off) / (sigma_m * std::sqrt(2.0 * std::numbers::pi));
}

double LikelihoodOf(const std::vector<DepthMeasurement>& measurements, double setback_m,
                    double thickness_m) {
  double product = 1.0;
  for (const DepthMeasurement& measurement : measurements) {
    const double off_m =
        measurement.behind_m - setback_m - (measurement.is_in_thickness ? thickness_m : 0.0);
    const double sigma_m = std::hypot(measurement.sigma_m,
                                      measurement.is_in_thickness ? kWithinStep_m : kFrontSigma_m);
    product *= (1.0 - kOther) * Normal(off_m, sigma_m) + kOther / kOtherRange_m;
  }
  return product;
}

// Marginalises over the thickness.
double Likelihood(const std::vector<DepthMeasurement>& measurements, double setback_m) {
  double sum = 0.0;
  for (int i = 0; i < kThicknesses; ++i) {
    sum += LikelihoodOf(measurements, setback_m, kThickest_m * (i + 0.5) / kThicknesses);
  }
  return sum / kThicknesses;
}

}  // namespace

bool ShowsNoReveal(std::span<const CameraView> views, const FrameRectangle& frame,
                   const RevealGrey& grey) {
  bool would_show = false;
  for (const CameraView& view : views) {
    for (const Side side : kAllSides) {
      const Evidence evidence = LookForReveal(view, frame, side, grey);
      if (evidence == Evidence::kReveal) return false;
      would_show |= evidence == Evidence::kNoReveal;
    }
  }
  return would_show;
}

SetbackPosterior InferSetback(const std::vector<DepthMeasurement>& measurements,
                              double prior_flush) {
  const double flush = prior_flush * Likelihood(measurements, 0.0);
  double sum = flush;
  double first = 0.0;
  double second = 0.0;
  const double nearest_m = prior_flush > 0.0 ? 0.0 : kNearestBelieved_m;
  const int count = static_cast<int>((kDeepestBelieved_m - nearest_m) / kStep_m);
  for (int i = 0; i < count; ++i) {
    const double setback_m = nearest_m + (i + 0.5) * kStep_m;
    const double weight = (1.0 - prior_flush) / count * Likelihood(measurements, setback_m);
    sum += weight;
    first += weight * setback_m;
    second += weight * setback_m * setback_m;
  }
  const double mean_m = first / sum;
  return {.flush = flush / sum,
          .setback = {mean_m, std::sqrt(std::max(0.0, second / sum - mean_m * mean_m))},
          .root_mean_square_m = std::sqrt(second / sum)};
}

}  // namespace fenestra
