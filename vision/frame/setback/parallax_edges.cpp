#include "vision/frame/setback/parallax_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/frame/measurement/side_sampling.h"

namespace fenestra {
namespace {

constexpr double kFrom_px = -10.0;
constexpr double kStep_px = 0.5;
constexpr double kMostInset = 0.3;  // Share of the frame's width.
constexpr double kNearestEdge_m = -0.15;
constexpr double kDeepestEdge_m = 0.25;
constexpr int kHalfStep = 2;    // One pixel on either side of an edge.
constexpr int kHalfWindow = 4;  // Half of the block around an edge that is matched: 2 px.
// An edge must stand out from those whose blur is in its block.
constexpr int kAlone = kHalfWindow + kHalfStep;
constexpr double kLeastRise_dn = 1.0;
constexpr double kLeastSigmas = 5.0;
constexpr double kLeastCorrelation = 0.9;
// Error of blur, rounding and interpolation, visible where there is little noise.
constexpr double kModel_px = 0.02;
// The corresponding error if another edge is near, possibly at another depth.
constexpr double kCrowded_px = 0.15;
constexpr double kCrowding = 0.25;  // Share of the edge's own rise.

struct Eye {
  double inwards_m;   // h
  double distance_m;  // z
};

Eye EyeOf(const CameraView& view, const FrameRectangle& frame, Side side) {
  const Eigen::Vector3d p_OC =
      frame.R_LO.transpose() * (view.X_CL.inverse().translation() - frame.p_LO);
  const double across = side == Side::kLeft ? p_OC.x() : -p_OC.x();
  return {0.5 * frame.width_m + across, p_OC.z()};
}

struct Place {
  double inset_m;
  double behind_m;
};

Place PlaceOf(const Eye& first, const Eye& second, double t0, double t1) {
  const double a0 = (first.inwards_m - t0) / first.distance_m;
  const double a1 = (second.inwards_m - t1) / second.distance_m;
  const double behind_m = (t1 - t0) / (a1 - a0);
  return {t0 - a0 * behind_m, behind_m};
}

// Place at which the second view sees a point that the first view sees at t0, if it is this far
// behind the front.
double SeenBySecond(const Eye& first, const Eye& second, double t0, double behind_m) {
  const double inset_m = t0 - (first.inwards_m - t0) / first.distance_m * behind_m;
  return (inset_m * second.distance_m + second.inwards_m * behind_m) /
         (second.distance_m + behind_m);
}

double Rise(const SideProfile& profile, int i) {
  return profile.Grey(i + kHalfStep) - profile.Grey(i - kHalfStep);
}

bool IsEdge(const SideProfile& profile, int i) {
  const double rise = std::abs(Rise(profile, i));
  const double noise = std::sqrt(profile.Variance(i - kHalfStep) + profile.Variance(i + kHalfStep));
  if (rise < std::max(kLeastRise_dn, kLeastSigmas * noise)) return false;
  for (int k = -kAlone; k <= kAlone; ++k) {
    const double other = std::abs(Rise(profile, i + k));
    if (other > rise || (other == rise && k < 0)) return false;
  }
  return true;
}

// Tells whether another edge begins just beyond the block, inwards (+1) or outwards (-1).
bool IsCrowded(const SideProfile& profile, int i, int direction) {
  const double least = kCrowding * std::abs(Rise(profile, i));
  for (int k = kHalfWindow + 1; k <= kAlone + kHalfWindow; ++k) {
    if (std::abs(Rise(profile, i + direction * k)) > least) return true;
  }
  return false;
}

// Correlation of two blocks; 1 if they differ by a constant.
double Correlation(const SideProfile& a, int i, const SideProfile& b, int j) {
  double mean_a = 0.0;
  double mean_b = 0.0;
  for (int k = -kHalfWindow; k <= kHalfWindow; ++k) {
    mean_a += a.Grey(i + k) / (2 * kHalfWindow + 1);
    mean_b += b.Grey(j + k) / (2 * kHalfWindow + 1);
  }
  double squares = 1e-9;
  double product = 0.0;
  for (int k = -kHalfWindow; k <= kHalfWindow; ++k) {
    const double in_a = a.Grey(i + k) - mean_a;
    const double in_b = b.Grey(j + k) - mean_b;
    squares += in_a * in_a + in_b * in_b;
    product += in_a * in_b;
  }
  return 2.0 * product / squares;
}

// Finds the place in `b`, from `low` to `high`, that best matches place i of `a`, refined by a
// parabola.
std::optional<double> BestMatch(const SideProfile& a, int i, const SideProfile& b, int low,
                                int high) {
  low = std::max(low, kHalfWindow + 1);
  high = std::min(high, b.size() - kHalfWindow - 2);
  double best = kLeastCorrelation;
  std::optional<int> where;
  for (int j = low; j <= high; ++j) {
    const double correlation = Correlation(a, i, b, j);
    if (correlation <= best) continue;
    best = correlation;
    where = j;
  }
  if (!where || *where == low || *where == high) return std::nullopt;
  const double before = Correlation(a, i, b, *where - 1);
  const double after = Correlation(a, i, b, *where + 1);
  return *where + 0.5 * (before - after) / std::min(-1e-12, before - 2.0 * best + after);
}

// Standard deviation of the shift between two blocks, in steps.
double SigmaOfShift(const SideProfile& a, int i, const SideProfile& b, int j) {
  double information = 1e-12;
  for (int k = -kHalfWindow; k <= kHalfWindow; ++k) {
    const double slope = 0.5 * (a.Grey(i + k + 1) - a.Grey(i + k - 1));
    // Neighbouring samples share pixels.
    information += kStep_px * slope * slope / (a.Variance(i + k) + b.Variance(j + k));
  }
  return std::hypot(1.0 / std::sqrt(information), kModel_px / kStep_px);
}

// A side as both views see it.
struct StereoProfile {
  Side side;
  Eye eye;
  Eye other;
  ProfileGrid grid;
  SideProfile a;
  SideProfile b;
};

std::optional<StereoProfile> ProfileOf(const CameraView& first, const CameraView& second,
                                       const FrameRectangle& frame, Side side) {
  const Eye eye = EyeOf(first, frame, side);
  const Eye other = EyeOf(second, frame, side);
  const double pixel_m = PixelAcross(first, frame, side);
  if (!(eye.distance_m > 0.0 && other.distance_m > 0.0 && pixel_m > 0.0)) return std::nullopt;
  ProfileGrid grid{.first_m = kFrom_px * pixel_m, .step_m = kStep_px * pixel_m, .count = 0};
  grid.count = static_cast<int>((kMostInset * frame.width_m - grid.first_m) / grid.step_m);
  return StereoProfile{.side = side,
                       .eye = eye,
                       .other = other,
                       .grid = grid,
                       .a = ProfileAcross(first, frame, side, grid),
                       .b = ProfileAcross(second, frame, side, grid)};
}

// The edge at place i of the first view's profile, if the second view shows it, too.
std::optional<ParallaxEdge> EdgeAt(const StereoProfile& profile, int i) {
  const auto& [side, eye, other, grid, a, b] = profile;
  const double t0 = grid.InsetAt(i);
  const auto index = [&](double behind_m) {
    return (SeenBySecond(profile.eye, profile.other, t0, behind_m) - profile.grid.first_m) /
           profile.grid.step_m;
  };
  const auto [low, high] = std::minmax({index(kNearestEdge_m), index(kDeepestEdge_m)});
  const auto found = BestMatch(a, i, b, static_cast<int>(std::floor(low)) - 1,
                               static_cast<int>(std::ceil(high)) + 1);
  if (!found) return std::nullopt;
  const Place place = PlaceOf(eye, other, t0, grid.InsetAt(*found));
  const double by_step =
      std::abs(PlaceOf(eye, other, t0, grid.InsetAt(*found + 1.0)).behind_m - place.behind_m);
  // This is false for NaN, too.
  if (!(std::isfinite(by_step) && place.behind_m > 1.5 * kNearestEdge_m &&
        place.behind_m < 1.5 * kDeepestEdge_m)) {
    return std::nullopt;
  }
  const bool is_crowded_outside = IsCrowded(a, i, -1);
  const bool is_crowded = is_crowded_outside || IsCrowded(a, i, 1);
  return ParallaxEdge{
      .side = side,
      .seen_inset_m = t0,
      .inset_m = place.inset_m,
      .behind_m = place.behind_m,
      .sigma_m = by_step * SigmaOfShift(a, i, b, static_cast<int>(std::lround(*found))),
      .crowding_m = is_crowded ? by_step * kCrowded_px / kStep_px : 0.0,
      .rise_dn = Rise(a, i),
      .is_crowded_outside = is_crowded_outside,
      .is_looked_across = eye.inwards_m < place.inset_m};
}

}  // namespace

std::vector<ParallaxEdge> FindParallaxEdges(const CameraView& first, const CameraView& second,
                                            const FrameRectangle& frame, Side side) {
  const auto profile = ProfileOf(first, second, frame, side);
  if (!profile) return {};
  std::vector<ParallaxEdge> edges;
  const int margin = kAlone + kHalfWindow + kHalfStep;
  for (int i = margin; i + margin < profile->grid.count; ++i) {
    if (!IsEdge(profile->a, i)) continue;
    if (const auto edge = EdgeAt(*profile, i)) edges.push_back(*edge);
  }
  return edges;
}

}  // namespace fenestra
