#include "core/detection/depth_reprojection.h"

#include <algorithm>
#include <cmath>

#include "core/system/check.h"

namespace fenestra {

DepthReprojection::DepthReprojection(const CameraModel& from, const Pose& X_KD,
                                     const CameraModel& to)
    : to_(to), p_KD_(X_KD.translation()), width_px_(from.width_px()) {
  for (int v = 0; v < from.height_px(); ++v) {
    for (int u = 0; u < from.width_px(); ++u) {
      const auto ray_D = from.UnprojectRay({u, v});
      rays_K_.push_back(std::nullopt);
      if (ray_D) rays_K_.back() = X_KD.rotation() * *ray_D;
    }
  }
}

DepthReprojection::Reprojected DepthReprojection::Reproject(const DepthImage& depth) const {
  FENESTRA_CHECK(depth.raw.cols == width_px_ && depth.raw.total() == rays_K_.size(),
                 "the depth image must have the size of its camera");
  const cv::Size size(to_.width_px(), to_.height_px());
  Reprojected reprojected{cv::Mat1i(size, kNowhere), cv::Mat1f::zeros(size)};
  for (int v = 0; v < depth.raw.rows; ++v) {
    for (int u = 0; u < depth.raw.cols; ++u) {
      const double z_D = depth.raw(v, u) * depth.unit_m;
      const int source = v * width_px_ + u;
      const auto& ray_K = rays_K_[static_cast<size_t>(source)];
      if (z_D == 0.0 || !ray_K) continue;
      const Eigen::Vector3d p_KQ = z_D * *ray_K + p_KD_;
      const auto pixel = to_.Project(p_KQ);
      if (!pixel || !to_.Contains(*pixel)) continue;
      // A pixel exactly on the far border would round to one beyond the image.
      const int x = std::clamp(static_cast<int>(std::lround(pixel->x())), 0, size.width - 1);
      const int y = std::clamp(static_cast<int>(std::lround(pixel->y())), 0, size.height - 1);
      float& nearest_m = reprojected.depth_m(y, x);
      const auto z_m = static_cast<float>(p_KQ.z());
      if (nearest_m != 0.0f && z_m >= nearest_m) continue;
      nearest_m = z_m;
      reprojected.source(y, x) = source;
    }
  }
  return reprojected;
}

}  // namespace fenestra
