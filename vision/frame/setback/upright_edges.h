#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vision/frame/setback/frame_setback.h"
#include "vision/frame/setback/parallax_edges.h"

namespace fenestra {

/// The edges that two views show along a vertical side of a rectangle, which may be the frame's own
/// or that of the wall around it.
struct UprightEdges {
  std::optional<ParallaxEdge> own;   ///< The rectangle's own edge, which is bright outside.
  std::vector<ParallaxEdge> within;  ///< Edges farther inwards.

  /// Whether the rectangle's edge lies in its plane, as far as parallax tells.
  bool IsInPlane() const;
};

struct UprightPair {
  UprightEdges left;
  UprightEdges right;

  bool AreInPlane() const { return left.IsInPlane() && right.IsInPlane(); }

  /// Whether both sides were found and exactly one of them is looked across, so that the wall's
  /// edge may hide the frame's on that side only.
  bool AreFarAndNear() const;

  /// Whether another edge lies just outside one of the rectangle's own, like the wall's edge
  /// outside a bright reveal. Fits of the rectangle's own edges are then slightly off.
  bool IsBesideOther() const;

  /// Measured depths of the front and of the frame's thickness. They are relative to the
  /// rectangle's plane, or to its edges where these lie in the plane, since the plane may be
  /// slightly tilted.
  std::vector<DepthMeasurement> Measurements() const;

  /// Updates the probability that the frame is flush by the depths of the rectangle's own sides: if
  /// it is flush they lie in the plane; if it is not, they may lie there by chance.
  double ProbablyFlush(double before) const;

  /// How far the foremost of the rectangle's own edges is behind the plane [m]; at most 0.
  double Foremost() const;
};

UprightPair FindUprightEdges(const CameraView& left, const CameraView& right,
                             const FrameRectangle& frame);

}  // namespace fenestra
