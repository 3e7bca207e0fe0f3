#include "vision/frame/frame_setback.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/frame/frame_border.h"

namespace fenestra {
namespace {

constexpr double kShallowest_m = 0.05;
constexpr double kDeepest_m = 0.30;
constexpr double kNarrowest_px = 4.5;  // Of a reveal that is told from the blur beside it.
constexpr double kClear_px = 2.0;      // From an edge, so that its blur is left behind.
constexpr double kEdge_px = 0.7;       // How well an edge in a mean profile is known.
const double kDarker = std::log(1.5);  // From reveal to frame; paints differ by more.
constexpr double kLeastSigma_m = 0.015;

struct SideView {
  double inwards_m;   // h: from the side to where the camera stands, along the front.
  double distance_m;  // z.
  double pixel_m;     // On the rectangle, across the side.
  double Inset(double depth_m) const { return inwards_m * depth_m / (distance_m + depth_m); }
  double Depth(double inset_m) const { return distance_m * inset_m / (inwards_m - inset_m); }
};

SideView Look(const CameraView& view, const FrameRectangle& frame, Side side) {
  const Eigen::Vector3d p_OC =
      frame.R_LO.transpose() * (view.X_CL.inverse().translation() - frame.p_LO);
  const double across = side == Side::kLeft ? -p_OC.x() : side == Side::kRight ? p_OC.x() : 0.0;
  const double up = side == Side::kTop ? p_OC.y() : side == Side::kBottom ? -p_OC.y() : 0.0;
  const bool upright = side == Side::kLeft || side == Side::kRight;
  const double half_m = 0.5 * (upright ? frame.width_m : frame.height_m);
  SideView look{.inwards_m = half_m - across - up, .distance_m = p_OC.z(), .pixel_m = 1.0};
  FrameRectangle inset = frame;
  inset.border_m = 0.02;
  inset.inner_relief_m = 0.0;
  const auto at_side = view.camera.Project(view.X_CL * frame.PointOn(side, Border::kOuter, 0.5));
  const auto within = view.camera.Project(view.X_CL * inset.PointOn(side, Border::kInner, 0.5));
  if (at_side && within) look.pixel_m = 0.02 / std::max(1e-3, (*at_side - *within).norm());
  return look;
}

enum class Sight { kNothing, kNoReveal, kReveal };

struct Reveal {
  Sight sight = Sight::kNothing;
  Setback setback{};
};

// Mean grey value above black at this inset.
std::optional<double> LightAt(const CameraView& view, FrameRectangle frame, Side side,
                              double inset_m, double black_dn) {
  frame.border_m = inset_m;
  frame.inner_relief_m = 0.0;
  const auto grey = MeanAlong(view, frame, side);
  if (!grey) return std::nullopt;
  return std::max(1.0, *grey - black_dn);
}

// Natural logarithm of the one over the other, 0 where noise alone may part them.
double LogRatio(double bright, double dark, double min_contrast_dn) {
  return std::abs(bright - dark) < min_contrast_dn ? 0.0 : std::log(bright / dark);
}

Reveal LookForReveal(const CameraView& view, const FrameRectangle& frame, Side side,
                     const RevealGrey& grey) {
  const SideView look = Look(view, frame, side);
  Reveal reveal;
  if (look.inwards_m <= 0.0 || look.distance_m <= 0.0) return reveal;
  const double step_m = 0.5 * look.pixel_m;
  const double most_m =
      std::min(look.Inset(kDeepest_m), 0.3 * std::min(frame.width_m, frame.height_m));
  const double clear_m = kClear_px * look.pixel_m;
  double darkest = 0.0;
  double where_m = 0.0;
  double t = 2.0 * clear_m;
  for (; t < most_m; t += step_m) {
    const auto before = LightAt(view, frame, side, t - clear_m, grey.black_dn);
    const auto after = LightAt(view, frame, side, t + clear_m, grey.black_dn);
    if (!before || !after) continue;
    const double darker = LogRatio(*before, *after, grey.min_contrast_dn);
    if (darker < -kDarker) break;  // The opening: here the frame ends.
    if (darker <= darkest) continue;
    darkest = darker;
    where_m = t;
  }
  if (darkest > kDarker) {
    const double depth_m = look.Depth(where_m);
    const double by_inset =
        look.distance_m * look.inwards_m / std::pow(look.inwards_m - where_m, 2);
    reveal.sight = Sight::kReveal;
    reveal.setback = {depth_m, std::max(kLeastSigma_m, by_inset * kEdge_px * look.pixel_m)};
  } else if (look.Inset(kShallowest_m) > kNarrowest_px * look.pixel_m &&
             t > look.Inset(kShallowest_m) + clear_m) {
    reveal.sight = Sight::kNoReveal;
  }
  return reveal;
}

struct Sighting {
  Side side;
  Setback setback;
};

// Those around the depth that most of them agree on.
std::vector<Sighting> Agreeing(const std::vector<Sighting>& seen) {
  std::vector<Sighting> best;
  for (const auto& [side, centre] : seen) {
    std::vector<Sighting> agreeing;
    for (const Sighting& other : seen) {
      const double tolerance_m = 2.0 * std::hypot(centre.sigma_m, other.setback.sigma_m);
      if (std::abs(other.setback.mean_m - centre.mean_m) <= tolerance_m) agreeing.push_back(other);
    }
    if (agreeing.size() > best.size()) best = agreeing;
  }
  return best;
}

}  // namespace

std::optional<Setback> FindSetback(std::span<const CameraView> views, const FrameRectangle& frame,
                                   const RevealGrey& grey) {
  std::vector<Sighting> seen;
  int without = 0;
  for (const CameraView& view : views) {
    for (const Side side : kAllSides) {
      const Reveal reveal = LookForReveal(view, frame, side, grey);
      if (reveal.sight == Sight::kReveal) seen.push_back({side, reveal.setback});
      if (reveal.sight == Sight::kNoReveal) ++without;
    }
  }
  if (seen.empty()) return without > 0 ? std::optional<Setback>({0.0, 0.0}) : std::nullopt;
  const std::vector<Sighting> best = Agreeing(seen);
  // One side alone may show the opening's edge instead.
  const bool sides_differ = std::any_of(best.begin(), best.end(), [&](const Sighting& other) {
    return other.side != best.front().side;
  });
  if (!sides_differ || 3 * best.size() < 2 * (seen.size() + static_cast<size_t>(without))) {
    return std::nullopt;
  }
  double sum = 0.0;
  double weight = 0.0;
  for (const auto& [side, setback] : best) {
    sum += setback.mean_m / (setback.sigma_m * setback.sigma_m);
    weight += 1.0 / (setback.sigma_m * setback.sigma_m);
  }
  return Setback{sum / weight, std::max(kLeastSigma_m, 1.0 / std::sqrt(weight))};
}

}  // namespace fenestra
