#include "vision/rgbd/paper/dark_cloud.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/system/check.h"

namespace fenestra {

DarkCloud CloudOf(const cv::Mat1b& mask, const cv::Mat1f& depth_m, const CameraModel& camera) {
  DarkCloud cloud{.mask = mask,
                  .depth_m = cv::Mat1f::zeros(mask.size()),
                  .points_K = {},
                  .dark_pixels = cv::countNonZero(mask)};
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask(v, u) == 0 || !(depth_m(v, u) > 0.0f)) continue;
      const auto ray_K = camera.UnprojectRay({u, v});
      if (!ray_K) continue;
      cloud.depth_m(v, u) = depth_m(v, u);
      cloud.points_K.push_back(static_cast<double>(depth_m(v, u)) * *ray_K);
    }
  }
  return cloud;
}

DarkCloud SegmentDark(const RegisteredImages& images, const CameraModel& camera,
                      int dark_below_dn) {
  FENESTRA_CHECK(images.color.size() == images.depth_m.size(), "images are not registered");
  cv::Mat1b mask;
  const double brightest_dark = dark_below_dn - 1.0;  // inRange includes its upper limit.
  cv::inRange(images.color, cv::Scalar::all(0.0), cv::Scalar::all(brightest_dark), mask);
  return CloudOf(mask, images.depth_m, camera);
}

std::vector<DarkCloud> ConnectedParts(const DarkCloud& cloud, const CameraModel& camera,
                                      int min_points, size_t most) {
  const cv::Mat1b with_depth = cloud.depth_m > 0.0f;
  cv::Mat1i labels;
  cv::Mat1i stats;
  cv::Mat1d centroids;
  const int count = cv::connectedComponentsWithStats(with_depth, labels, stats, centroids, 8);
  std::vector<int> large;
  for (int label = 1; label < count; ++label) {  // Label 0 is the background.
    if (stats(label, cv::CC_STAT_AREA) >= min_points) large.push_back(label);
  }
  std::stable_sort(large.begin(), large.end(), [&stats](int a, int b) {
    return stats(a, cv::CC_STAT_AREA) > stats(b, cv::CC_STAT_AREA);
  });
  if (large.size() > most) large.resize(most);
  std::vector<DarkCloud> parts;
  for (const int label : large) parts.push_back(CloudOf(labels == label, cloud.depth_m, camera));
  return parts;
}

}  // namespace fenestra
