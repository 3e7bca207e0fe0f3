#include "vision/rgbd/plane/depth_points.h"

#include <algorithm>

namespace fenestra {
namespace {

constexpr int kMostColumns = 400;

// Chooses every n-th column such that a mirrored image is read at the mirrored columns.
std::vector<int> MirroredColumns(int width_px, int every) {
  std::vector<int> columns;
  for (int u = every / 2; 2 * u + 1 < width_px; u += every) columns.push_back(u);
  const size_t half = columns.size();
  if (every == 1 && width_px % 2 == 1) columns.push_back(width_px / 2);
  for (size_t i = half; i-- > 0;) columns.push_back(width_px - 1 - columns[i]);
  return columns;
}

}  // namespace

DepthPointReader::DepthPointReader(const RgbdCalibration& calibration)
    : p_KD_(calibration.X_KD.translation()),
      color_(calibration.color.parameters()),
      columns_((calibration.depth.width_px() + kMostColumns - 1) / kMostColumns),
      rows_(2 * columns_) {
  const std::vector<int> read = MirroredColumns(calibration.depth.width_px(), columns_);
  for (int v = rows_ / 2; v < calibration.depth.height_px(); v += rows_) {
    for (const int u : read) {
      const auto ray_D = calibration.depth.UnprojectRay({u, v});
      if (!ray_D) continue;
      rays_.push_back({{u, v}, *ray_D, calibration.X_KD.rotation() * *ray_D});
    }
  }
}

std::vector<DepthPoint> DepthPointReader::Read(const DepthImage& depth) const {
  std::vector<DepthPoint> points;
  points.reserve(rays_.size());
  for (const Ray& ray : rays_) {
    const double z_m = depth.raw(ray.pixel) * depth.unit_m;
    if (!(z_m > 0.0)) continue;
    const Eigen::Vector3d p_K = z_m * ray.turned + p_KD_;
    if (!(p_K.z() > 0.0)) continue;
    const double u = color_.fx_px * p_K.x() / p_K.z() + color_.cx_px;
    const double v = color_.fy_px * p_K.y() / p_K.z() + color_.cy_px;
    points.push_back(
        {ray.pixel, ray.ray_D, 1.0 / z_m, {static_cast<float>(u), static_cast<float>(v)}});
  }
  return points;
}

}  // namespace fenestra
