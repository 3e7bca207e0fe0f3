#include "vision/frame/measurement/edge_shift.h"

#include <cmath>

namespace fenestra {
namespace {

constexpr double kCorrelationLength = 0.27;  // See the header.

}  // namespace

double EdgeShift::SigmaAt(const Eigen::Vector2d& place) const {
  return centre_px + (corner_px - centre_px) * place.squaredNorm();
}

Eigen::Vector2d PlaceInImage(const CameraModel& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d size(camera.width_px(), camera.height_px());
  const Eigen::Vector2d centre = 0.5 * (size - Eigen::Vector2d::Ones());
  return (pixel - centre) / (0.5 * size.norm());
}

double ShiftCorrelation(const Eigen::Vector2d& place, const Eigen::Vector2d& other) {
  constexpr double kLength2 = kCorrelationLength * kCorrelationLength;
  return std::exp(-0.5 * (place - other).squaredNorm() / kLength2);
}

}  // namespace fenestra
