#include "tests/support/planar_target.h"

#include <cmath>
#include <limits>

namespace fenestra::testing {
namespace {

// The point in O where the camera's ray meets the plane z_O = 0, and its depth.
struct Hit {
  Eigen::Vector3d p_OQ;
  double depth_m;
};

std::optional<Hit> Intersect(const CameraModel& camera, const Pose& X_OC,
                             const Eigen::Vector2d& pixel) {
  const auto ray_C = camera.UnprojectRay(pixel);
  if (!ray_C) return std::nullopt;
  const Eigen::Vector3d ray_O = X_OC.rotation() * *ray_C;
  const double depth_m = -X_OC.translation().z() / ray_O.z();  // The ray has z_C = 1.
  if (!std::isfinite(depth_m) || depth_m <= 0.0) return std::nullopt;
  return Hit{X_OC.translation() + depth_m * ray_O, depth_m};
}

}  // namespace

cv::Mat1f BorderCoverage(const CameraModel& camera, const Pose& X_CO, const PlanarTarget& target,
                         int samples) {
  const Pose X_OC = X_CO.inverse();
  const double outer = 0.5 * target.outer_side_m;
  const double inner = outer - target.border_m;
  cv::Mat1f coverage(camera.height_px(), camera.width_px());
  for (int v = 0; v < coverage.rows; ++v) {
    for (int u = 0; u < coverage.cols; ++u) {
      int inside = 0;
      for (int i = 0; i < samples * samples; ++i) {
        const Eigen::Vector2d pixel(u - 0.5 + (i % samples + 0.5) / samples,
                                    v - 0.5 + (i / samples + 0.5) / samples);
        const auto hit = Intersect(camera, X_OC, pixel);
        if (!hit) continue;
        const double reach = std::max(std::abs(hit->p_OQ.x()), std::abs(hit->p_OQ.y()));
        if (reach <= outer && reach >= inner) ++inside;
      }
      coverage(v, u) = static_cast<float>(inside) / static_cast<float>(samples * samples);
    }
  }
  return coverage;
}

cv::Mat1f PlaneDepth(const CameraModel& camera, const Pose& X_CO) {
  const Pose X_OC = X_CO.inverse();
  cv::Mat1f depth(camera.height_px(), camera.width_px());
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const auto hit = Intersect(camera, X_OC, {u, v});
      depth(v, u) =
          hit ? static_cast<float>(hit->depth_m) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return depth;
}

Pose FacingWindow(double distance_m, const Eigen::Vector2d& offset_m) {
  Eigen::Matrix3d R_CO = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return Pose(R_CO, {-offset_m.x(), -offset_m.y(), distance_m});
}

}  // namespace fenestra::testing
