#pragma once

#include <Eigen/Core>
#include <array>

#include "core/detection/detection.h"
#include "vision/frame/detection/edge_segment.h"

namespace fenestra {

/// The two borders of a window frame: towards the wall, and towards the opening.
enum class Border { kOuter, kInner };

/// The front of a window frame: a plane rectangle with a border of constant width. Frame O has its
/// origin at the centroid; as seen from the front, +X points right, +Y up and +Z out of it. L is
/// the unrectified left camera.
///
/// The edges that are seen as its sides may lie in front of or behind that plane: on the wall's
/// face, a sill, or the rebate of the panes. This offset is their relief; it is 0 for a frame that
/// is painted on or flush with the wall.
struct FrameRectangle {
  Eigen::Matrix3d R_LO = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_LO = Eigen::Vector3d::Zero();
  double width_m = 0.0;                       ///< Outer.
  double height_m = 0.0;                      ///< Outer.
  double border_m = 0.0;                      ///< Width of the frame itself, seen from its front.
  std::array<double, 4> outer_relief_m = {};  ///< For each side, along +Z.
  double inner_relief_m = 0.0;

  /// A small change of the parameters, in this order: rotation vector in O [rad], p_LO, width,
  /// height, border, the reliefs of the four outer sides, the relief of the inner ones [m].
  static constexpr int kParameters = 14;
  using Step = Eigen::Matrix<double, kParameters, 1>;
  FrameRectangle Moved(const Step& step) const;

  struct SidePoint {
    Eigen::Vector3d p_LQ;
    Eigen::Matrix<double, 3, kParameters> by_parameters;
  };
  /// The point on a side at the given share of the way from its first corner, clockwise as seen.
  Eigen::Vector3d PointOn(Side side, Border border, double share) const;
  SidePoint LineariseOn(Side side, Border border, double share) const;

  /// Approximates four corners (top left, top right, bottom right, bottom left) by a rectangle: its
  /// centre is their mean, its axes are the mean directions of opposite sides made perpendicular,
  /// and its sizes are the mean lengths of opposite sides.
  static FrameRectangle FromCorners(const std::array<Eigen::Vector3d, 4>& p_LV);

  WindowEstimate ToEstimate() const;

 private:
  Eigen::Vector3d InFrame(Side side, Border border, double share) const;
};

}  // namespace fenestra
