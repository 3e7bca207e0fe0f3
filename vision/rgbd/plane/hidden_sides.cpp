#include "vision/rgbd/plane/hidden_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "vision/frame/setback/settle_depth.h"

namespace fenestra {

FrameRectangle SetBack(const FrameRectangle& frame, const Eigen::Vector3d& p_LC, double by_m) {
  const double distance_m = -frame.R_LO.col(2).dot(frame.p_LO - p_LC);
  const double factor = (distance_m + by_m) / distance_m;
  FrameRectangle moved = frame;
  moved.p_LO = p_LC + factor * (frame.p_LO - p_LC);
  moved.width_m *= factor;
  moved.height_m *= factor;
  moved.border_m *= factor;
  return moved;
}

FrameRectangle WithHiddenSides(const FrameRectangle& frame, const Eigen::Vector3d& p_LC,
                               double setback_m) {
  FrameRectangle moved = frame;
  if (!(setback_m > 0.0)) return moved;
  const Eigen::Vector3d p_OC = frame.R_LO.transpose() * (p_LC - frame.p_LO);
  const double share = setback_m / p_OC.z();  // Of the way from the front to the camera.
  std::array<double, 4> reach_m = {};         // Of each side from the middle.
  for (size_t i = 0; i < 4; ++i) {
    const double sign = i < 2 ? 1.0 : -1.0;  // Top and right; bottom and left.
    const bool level = i % 2 == 0;
    const double at_m = 0.5 * (level ? frame.height_m : frame.width_m);
    const double camera_m = sign * (level ? p_OC.y() : p_OC.x());
    const bool is_hidden = camera_m > at_m;
    reach_m[i] = is_hidden ? at_m + share * (camera_m - at_m) : at_m;
    moved.outer_relief_m[i] = is_hidden ? setback_m : 0.0;
  }
  moved.height_m = reach_m[0] + reach_m[2];
  moved.width_m = reach_m[1] + reach_m[3];
  moved.p_LO += 0.5 * (reach_m[1] - reach_m[3]) * frame.R_LO.col(0) +
                0.5 * (reach_m[0] - reach_m[2]) * frame.R_LO.col(1);
  return moved;
}

void AddSetback(const CameraView& view, bool is_fitted, const FramePlanes& planes, FrameFit& fit) {
  const double depth_m = std::max(std::abs(planes.setback_m), planes.setback_sigma_m);
  if (!(depth_m > 0.0)) return;
  AddParallax(std::span(&view, 1), {.upright_m = depth_m, .level_m = depth_m}, fit);
  if (is_fitted || planes.planes.size() > 1) return;
  const Eigen::Vector3d off = planes.setback_sigma_m * fit.adjustment.frame.R_LO.col(2);
  fit.adjustment.covariance.block<3, 3>(3, 3) += off * off.transpose();
}

}  // namespace fenestra
