#pragma once

#include <Eigen/Core>
#include <array>

#include "core/detection.h"
#include "vision/frame/edge_segment.h"

namespace fenestra {

/// Against the wall, or against the opening.
enum class Border { kOuter, kInner };

/// A frame's front: a plane rectangle with a border of one width. O: origin at its centroid, +X to
/// the right and +Y up as seen from its front, +Z out of it. L: the unrectified left camera.
///
/// What is seen as its sides may stand before or behind that plane: a wall's face, a sill, or the
/// rebate of the panes. That is their relief, 0 for a frame that is painted or flush.
struct FrameRectangle {
  Eigen::Matrix3d R_LO = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_LO = Eigen::Vector3d::Zero();
  double width_m = 0.0;                       ///< Outer.
  double height_m = 0.0;                      ///< Outer.
  double border_m = 0.0;                      ///< Of the frame, seen from its front.
  std::array<double, 4> outer_relief_m = {};  ///< By side, along +Z.
  double inner_relief_m = 0.0;

  /// Small changes, in this order: rotation vector in O [rad], p_LO, width, height, border, relief
  /// of the outer sides, of the inner ones [m].
  static constexpr int kParameters = 14;
  using Step = Eigen::Matrix<double, kParameters, 1>;
  FrameRectangle Moved(const Step& step) const;

  struct SidePoint {
    Eigen::Vector3d p_LQ;
    Eigen::Matrix<double, 3, kParameters> by_parameters;
  };
  /// The point of a side at this share of the way from its first corner, clockwise as seen.
  Eigen::Vector3d PointOn(Side side, Border border, double share) const;
  SidePoint LineariseOn(Side side, Border border, double share) const;

  /// The rectangle near four corners (top left, top right, bottom right, bottom left): their mean,
  /// the mean directions of opposite sides made perpendicular, and their mean lengths.
  static FrameRectangle FromCorners(const std::array<Eigen::Vector3d, 4>& p_LV);

  WindowEstimate ToEstimate() const;

 private:
  Eigen::Vector3d InFrame(Side side, Border border, double share) const;
};

}  // namespace fenestra
