#include "vision/frame/setback/upright_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/frame/measurement/side_sampling.h"

namespace fenestra {
namespace {

constexpr double kAtSide_px = 2.0;
constexpr double kClearOfSide_px = 2.0;  // Distance of an inner edge from the side's own.
// Share of the strongest edge; a weaker one may be a change of the light.
constexpr double kLeastShare = 0.03;
constexpr double kInPlaneSigmas = 3.0;
constexpr double kInPlane_m = 0.004;
constexpr double kApart_m = 0.02;  // Shallowest reveal that can be separated from blur.
// Range of the apparent depth of sides that are blends of the wall's and the frame's edges.
constexpr double kBlendRange_m = 0.05;

UprightEdges EdgesOf(const CameraView& first, const CameraView& second, const FrameRectangle& frame,
                     Side side) {
  const double pixel_m = PixelAcross(first, frame, side);
  std::vector<ParallaxEdge> found = FindParallaxEdges(first, second, frame, side);
  double most_dn = 0.0;
  for (const ParallaxEdge& edge : found) most_dn = std::max(most_dn, std::abs(edge.rise_dn));
  std::erase_if(found, [&](const ParallaxEdge& edge) {
    return std::abs(edge.rise_dn) < kLeastShare * most_dn;
  });
  UprightEdges edges;
  for (const ParallaxEdge& edge : found) {
    const double off_m = std::abs(edge.seen_inset_m);
    if (edge.rise_dn < 0.0 && off_m < kAtSide_px * pixel_m &&
        (!edges.own || off_m < std::abs(edges.own->seen_inset_m))) {
      edges.own = edge;
    }
  }
  const double from_m = (edges.own ? edges.own->seen_inset_m : 0.0) + kClearOfSide_px * pixel_m;
  for (const ParallaxEdge& edge : found) {
    if (edge.seen_inset_m > from_m) edges.within.push_back(edge);
  }
  return edges;
}

void AddMeasurements(const UprightEdges& edges, bool in_plane,
                     std::vector<DepthMeasurement>& measurements) {
  const double from_m = in_plane ? edges.own->behind_m : 0.0;
  const double from_sigma_m = in_plane ? edges.own->sigma_m : 0.0;
  for (const ParallaxEdge& edge : edges.within) {
    measurements.push_back({.behind_m = edge.behind_m - from_m,
                            .sigma_m = std::hypot(edge.sigma_m, edge.crowding_m, from_sigma_m),
                            .is_in_thickness = edge.rise_dn > 0.0 && !edge.is_looked_across});
  }
}

// The frame's own edge on the side that is not looked across, if its depth differs significantly
// from that of the wall's edge on the other side.
std::optional<DepthMeasurement> FarSide(const UprightPair& pair) {
  if (!pair.AreFarAndNear()) return std::nullopt;
  const bool left_is_near = pair.left.own->is_looked_across;
  const ParallaxEdge& near = left_is_near ? *pair.left.own : *pair.right.own;
  const ParallaxEdge& far = left_is_near ? *pair.right.own : *pair.left.own;
  const double least_m = kApart_m + kInPlaneSigmas * std::hypot(far.sigma_m, near.sigma_m);
  if (far.behind_m - near.behind_m < least_m) return std::nullopt;
  return DepthMeasurement{.behind_m = far.behind_m,
                          .sigma_m = std::hypot(far.sigma_m, far.crowding_m),
                          .is_in_thickness = false};
}

}  // namespace

bool UprightEdges::IsInPlane() const {
  return own && std::abs(own->behind_m) < kInPlaneSigmas * own->sigma_m + kInPlane_m;
}

bool UprightPair::AreFarAndNear() const {
  return left.own && right.own && left.own->is_looked_across != right.own->is_looked_across;
}

bool UprightPair::IsBesideOther() const {
  return (left.own && left.own->is_crowded_outside) || (right.own && right.own->is_crowded_outside);
}

std::vector<DepthMeasurement> UprightPair::Measurements() const {
  const bool in_plane = AreInPlane();
  std::vector<DepthMeasurement> measurements;
  AddMeasurements(left, in_plane, measurements);
  AddMeasurements(right, in_plane, measurements);
  if (const auto far = in_plane ? std::nullopt : FarSide(*this)) measurements.push_back(*far);
  return measurements;
}

double UprightPair::ProbablyFlush(double before) const {
  if (!AreInPlane()) return 0.0;
  double flush = before;
  for (const UprightEdges* edges : {&left, &right}) {
    const double sigma_m = std::hypot(edges->own->sigma_m, 0.5 * kInPlane_m);
    const double off = edges->own->behind_m / sigma_m;
    const double density =
        std::exp(-0.5 * off * off) / (sigma_m * std::sqrt(2.0 * std::numbers::pi));
    flush *= density / (density + 1.0 / kBlendRange_m);
  }
  return flush;
}

double UprightPair::Foremost() const {
  double foremost_m = 0.0;
  for (const UprightEdges* edges : {&left, &right}) {
    if (edges->own) foremost_m = std::min(foremost_m, edges->own->behind_m);
  }
  return foremost_m;
}

UprightPair FindUprightEdges(const CameraView& left, const CameraView& right,
                             const FrameRectangle& frame) {
  // Each side is searched from the view on that side, so that mirrored views give mirrored edges.
  return {EdgesOf(left, right, frame, Side::kLeft), EdgesOf(right, left, frame, Side::kRight)};
}

}  // namespace fenestra
