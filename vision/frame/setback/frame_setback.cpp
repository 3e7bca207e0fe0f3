#include "vision/frame/setback/frame_setback.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/frame/measurement/frame_border.h"
#include "vision/frame/measurement/side_profile.h"

namespace fenestra {
namespace {

constexpr double kShallowest_m = 0.05;
constexpr double kDeepest_m = 0.30;
constexpr double kNarrowest_px = 4.5;  // Of a reveal that is told from the blur beside it.
constexpr double kClear_px = 2.0;      // From an edge, so that its blur is left behind.
const double kDarker = std::log(1.5);  // From reveal to frame; paints differ by more.

struct SideView {
  double inwards_m;   // h: from the side to where the camera stands, along the front.
  double distance_m;  // z.
  double pixel_m;     // On the rectangle, across the side.
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

enum class Sight { kNothing, kNoReveal, kReveal };

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

Sight LookForReveal(const CameraView& view, const FrameRectangle& frame, Side side,
                    const RevealGrey& grey) {
  const SideView look = Look(view, frame, side);
  if (look.inwards_m <= 0.0 || look.distance_m <= 0.0 || look.pixel_m <= 0.0) {
    return Sight::kNothing;
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
    if (darker > kDarker) return Sight::kReveal;
    if (darker < -kDarker) break;  // The opening: here the frame ends.
  }
  const bool would_show = look.Inset(kShallowest_m) > kNarrowest_px * look.pixel_m &&
                          t > look.Inset(kShallowest_m) + clear_m;
  return would_show ? Sight::kNoReveal : Sight::kNothing;
}

}  // namespace

bool ShowsNoReveal(std::span<const CameraView> views, const FrameRectangle& frame,
                   const RevealGrey& grey) {
  bool would_show = false;
  for (const CameraView& view : views) {
    for (const Side side : kAllSides) {
      const Sight sight = LookForReveal(view, frame, side, grey);
      if (sight == Sight::kReveal) return false;
      would_show |= sight == Sight::kNoReveal;
    }
  }
  return would_show;
}

}  // namespace fenestra
