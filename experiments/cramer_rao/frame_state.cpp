#include "experiments/cramer_rao/frame_state.h"

#include <Eigen/Geometry>

namespace fenestra {

FrameState FrameState::Of(const WindowTruth& window, double border_m) {
  Eigen::Matrix3d R_CO;
  R_CO.col(0) = (window.p_CV[1] - window.p_CV[0]).normalized();
  R_CO.col(2) = window.normal_C;
  R_CO.col(1) = R_CO.col(2).cross(R_CO.col(0));
  return {.X_CO = Pose(R_CO, window.p_CO),
          .width_m = window.width_m,
          .height_m = window.height_m,
          .border_m = border_m};
}

FramePoint PointOn(const FrameState& frame, FrameEdge edge, const Eigen::Vector2d& place) {
  const bool inner = edge == FrameEdge::kInner;
  const double inset_m = inner ? frame.border_m : 0.0;
  const Eigen::Vector3d p_OQ(place.x() * (0.5 * frame.width_m - inset_m),
                             place.y() * (0.5 * frame.height_m - inset_m), 0.0);
  const Eigen::Matrix3d& R_CO = frame.X_CO.rotation();
  FramePoint point{.p_CQ = frame.X_CO * p_OQ, .by_frame = {}};
  point.by_frame.leftCols<3>().setIdentity();
  point.by_frame.middleCols<3>(3) = -CrossMatrix(R_CO * p_OQ);
  point.by_frame.col(kWidthUnknown) = 0.5 * place.x() * R_CO.col(0);
  point.by_frame.col(kHeightUnknown) = 0.5 * place.y() * R_CO.col(1);
  point.by_frame.col(8) =
      inner ? Eigen::Vector3d(-R_CO.leftCols<2>() * place) : Eigen::Vector3d::Zero().eval();
  return point;
}

}  // namespace fenestra
