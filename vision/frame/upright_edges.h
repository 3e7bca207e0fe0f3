#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vision/frame/front_belief.h"
#include "vision/frame/parallax_edges.h"

namespace fenestra {

/// What two views show along an upright side of a rectangle that may be a frame's or its wall's.
struct UprightEdges {
  std::optional<ParallaxEdge> own;   ///< The rectangle's: bright outside.
  std::vector<ParallaxEdge> within;  ///< Farther inwards.

  /// Whether the rectangle's edge is in its plane, as well as parallax tells.
  bool IsInPlane() const;
};

struct UprightPair {
  UprightEdges left;
  UprightEdges right;

  bool AreInPlane() const { return left.IsInPlane() && right.IsInPlane(); }

  /// Whether one side is looked across and the other is not, so that the wall's edge may hide the
  /// frame's on the former and not on the latter, and both were found.
  bool AreFarAndNear() const;

  /// Whether there is another edge just outside of one of its own, as the wall's outside of a
  /// bright reveal: then fits of its own are a little off.
  bool IsBesideOther() const;

  /// Depths of the front and of the frame's thickness, from the rectangle's plane; from its edges
  /// where these are in it, as a plane may be turned a little.
  std::vector<DepthSight> Sights() const;

  /// Probability that the rectangle is flush, given that of before its own sides were looked at.
  /// These may be in its plane by chance, but must be if it is.
  double ProbablyFlush(double before) const;

  /// How far the foremost of its own edges is behind the plane; at most 0.
  double Foremost() const;
};

UprightPair FindUprightEdges(const CameraView& left, const CameraView& right,
                             const FrameRectangle& frame);

}  // namespace fenestra
