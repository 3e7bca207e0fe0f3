#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/geometry/pose.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// A frame as it truly stands before the scored camera C: two rectangles with one centre in the
/// plane z = 0 of frame O (+x to the right, +y up). Its unknowns, in this order: the centroid p_CO
/// [m]; a turn δ about it, R = exp(δ) R_CO [rad]; width, height and border [m].
struct FrameState {
  Pose X_CO;
  double width_m;
  double height_m;
  double border_m;  ///< From the outer rectangle to the inner one.

  static FrameState Of(const WindowTruth& window, double border_m);
};

inline constexpr int kFrameUnknowns = 9;
inline constexpr int kCentroidUnknowns = 3;
inline constexpr int kWidthUnknown = 6;
inline constexpr int kHeightUnknown = 7;

/// A point on one of the rectangles in C, and its derivatives by the frame's unknowns.
struct FramePoint {
  Eigen::Vector3d p_CQ;
  Eigen::Matrix<double, 3, kFrameUnknowns> by_frame;
};

enum class FrameEdge { kOuter, kInner };

/// `place`: (-1, -1) is the rectangle's bottom left, (1, 1) its top right.
FramePoint PointOn(const FrameState& frame, FrameEdge edge, const Eigen::Vector2d& place);

}  // namespace fenestra
