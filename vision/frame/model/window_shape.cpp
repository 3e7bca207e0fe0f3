#include "vision/frame/model/window_shape.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Vector3d;

double RelativeDifference(double a, double b) {
  return std::abs(a - b) / (0.5 * (a + b));
}

}  // namespace

WindowShape MeasureShape(const std::array<Vector3d, 4>& p_CV) {
  std::array<Vector3d, 4> side;
  for (size_t i = 0; i < 4; ++i) side[i] = p_CV[(i + 1) % 4] - p_CV[i];
  WindowShape shape;
  shape.width_m = 0.5 * (side[0].norm() + side[2].norm());
  shape.height_m = 0.5 * (side[1].norm() + side[3].norm());
  shape.taper = std::max(RelativeDifference(side[0].norm(), side[2].norm()),
                         RelativeDifference(side[1].norm(), side[3].norm()));
  for (size_t i = 0; i < 4; ++i) {
    const Vector3d& next = side[(i + 1) % 4];
    const double sine = std::abs(side[i].normalized().dot(next.normalized()));
    shape.skew_rad = std::max(shape.skew_rad, std::asin(std::min(1.0, sine)));
  }
  return shape;
}

}  // namespace fenestra
