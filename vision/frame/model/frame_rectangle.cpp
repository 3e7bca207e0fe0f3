#include "vision/frame/model/frame_rectangle.h"

#include <Eigen/Geometry>

#include "core/geometry/pose.h"

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Coordinates from -1 to 1 across the frame; (-1, 1) is top left.
Vector2d Place(Side side, double share) {
  const double along = 2.0 * share - 1.0;
  switch (side) {
    case Side::kTop:
      return {along, 1.0};
    case Side::kRight:
      return {1.0, -along};
    case Side::kBottom:
      return {-along, -1.0};
    case Side::kLeft:
      break;
  }
  return {-1.0, along};
}

}  // namespace

FrameRectangle FrameRectangle::Moved(const Step& step) const {
  FrameRectangle moved = *this;
  moved.R_LO = R_LO * RotationFromVector(step.head<3>());
  moved.p_LO += step.segment<3>(3);
  moved.width_m += step[6];
  moved.height_m += step[7];
  moved.border_m += step[8];
  for (int i = 0; i < 4; ++i) moved.outer_relief_m[i] += step[9 + i];
  moved.inner_relief_m += step[13];
  return moved;
}

Vector3d FrameRectangle::InFrame(Side side, Border border, double share) const {
  const double inset_m = border == Border::kInner ? border_m : 0.0;
  const Vector2d place = Place(side, share);
  const double relief_m =
      border == Border::kInner ? inner_relief_m : outer_relief_m[static_cast<size_t>(side)];
  return {place.x() * (0.5 * width_m - inset_m), place.y() * (0.5 * height_m - inset_m), relief_m};
}

Vector3d FrameRectangle::PointOn(Side side, Border border, double share) const {
  return R_LO * InFrame(side, border, share) + p_LO;
}

FrameRectangle::SidePoint FrameRectangle::LineariseOn(Side side, Border border,
                                                      double share) const {
  const Vector3d p_OQ = InFrame(side, border, share);
  const Vector2d place = Place(side, share);
  SidePoint point{R_LO * p_OQ + p_LO, {}};
  point.by_parameters.setZero();
  point.by_parameters.leftCols<3>() = -R_LO * CrossMatrix(p_OQ);
  point.by_parameters.middleCols<3>(3) = Matrix3d::Identity();
  point.by_parameters.col(6) = R_LO.col(0) * 0.5 * place.x();
  point.by_parameters.col(7) = R_LO.col(1) * 0.5 * place.y();
  if (border == Border::kInner) {
    point.by_parameters.col(8) = -R_LO.col(0) * place.x() - R_LO.col(1) * place.y();
    point.by_parameters.col(13) = R_LO.col(2);
  } else {
    point.by_parameters.col(9 + static_cast<int>(side)) = R_LO.col(2);
  }
  return point;
}

FrameRectangle FrameRectangle::FromCorners(const std::array<Vector3d, 4>& p_LV) {
  const Vector3d across = 0.5 * (p_LV[1] - p_LV[0] + p_LV[2] - p_LV[3]);
  const Vector3d up = 0.5 * (p_LV[0] - p_LV[3] + p_LV[1] - p_LV[2]);
  FrameRectangle frame;
  frame.p_LO = 0.25 * (p_LV[0] + p_LV[1] + p_LV[2] + p_LV[3]);
  frame.width_m = across.norm();
  frame.height_m = up.norm();
  const Vector3d z = across.cross(up).normalized();
  // Both directions share the departure from a right angle.
  const Vector3d diagonal = (across.normalized() + up.normalized()).normalized();
  const Vector3d other = diagonal.cross(z).normalized();
  frame.R_LO.col(0) = (diagonal + other).normalized();
  frame.R_LO.col(1) = (diagonal - other).normalized();
  frame.R_LO.col(2) = z;
  return frame;
}

WindowEstimate FrameRectangle::ToEstimate() const {
  WindowEstimate estimate;
  estimate.p_CO = p_LO;
  for (const Side side : kAllSides) {
    const Vector2d place = Place(side, 0.0);
    estimate.p_CV[static_cast<size_t>(side)] =
        R_LO * Vector3d(0.5 * width_m * place.x(), 0.5 * height_m * place.y(), 0.0) + p_LO;
  }
  estimate.normal_C = R_LO.col(2);
  return estimate;
}

}  // namespace fenestra
