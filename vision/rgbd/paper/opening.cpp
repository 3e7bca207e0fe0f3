#include "vision/rgbd/paper/opening.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

constexpr double kShrink = 0.5;
constexpr int kFractionBits = 8;  // Fractional bits of a pixel in cv::fillConvexPoly.
constexpr int kPlaces = 32;       // Places along a side.

// Tells at which pixels of the image the cloud has a point on the plane.
class OnPlane {
 public:
  OnPlane(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
          const PlaneTolerance& tolerance)
      : depth_m_(cloud.depth_m), camera_(camera), plane_(plane), tolerance_(tolerance) {}

  bool At(const cv::Point& pixel) const {
    if (!pixel.inside(cv::Rect({0, 0}, depth_m_.size()))) return false;
    const double z_m = depth_m_(pixel);
    if (!(z_m > 0.0)) return false;
    const auto ray_K = camera_.UnprojectRay({pixel.x, pixel.y});
    return ray_K && std::abs(plane_.SignedDistance(z_m * *ray_K)) <= tolerance_.At(z_m);
  }

  bool Near(const Eigen::Vector3d& p_KQ) const {
    const auto pixel = camera_.Project(p_KQ);
    if (!pixel) return false;
    const cv::Point middle(static_cast<int>(std::lround(pixel->x())),
                           static_cast<int>(std::lround(pixel->y())));
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        if (At(middle + cv::Point(du, dv))) return true;
      }
    }
    return false;
  }

 private:
  const cv::Mat1f& depth_m_;
  const CameraModel& camera_;
  const Plane& plane_;
  const PlaneTolerance& tolerance_;
};

}  // namespace

double FilledShare(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
                   const PlaneTolerance& tolerance, const FourVertices& p_KV) {
  const Eigen::Vector3d middle = 0.25 * (p_KV[0] + p_KV[1] + p_KV[2] + p_KV[3]);
  std::vector<cv::Point> outline;
  for (const Eigen::Vector3d& p_KQ : p_KV) {
    const auto pixel = camera.Project(middle + kShrink * (p_KQ - middle));
    if (!pixel) return 0.0;
    const double scale = 1 << kFractionBits;
    outline.emplace_back(static_cast<int>(std::lround(scale * pixel->x())),
                         static_cast<int>(std::lround(scale * pixel->y())));
  }
  cv::Mat1b inside(cloud.depth_m.size(), uint8_t{0});
  cv::fillConvexPoly(inside, outline, 255, cv::LINE_8, kFractionBits);
  std::vector<cv::Point> pixels;
  cv::findNonZero(inside, pixels);
  const OnPlane on_plane(cloud, camera, plane, tolerance);
  const auto filled = std::count_if(pixels.begin(), pixels.end(),
                                    [&](const cv::Point& pixel) { return on_plane.At(pixel); });
  return pixels.empty() ? 0.0 : static_cast<double>(filled) / static_cast<double>(pixels.size());
}

double SeenShare(const DarkCloud& cloud, const CameraModel& camera, const Plane& plane,
                 const PlaneTolerance& tolerance, const FourVertices& p_KV) {
  const OnPlane on_plane(cloud, camera, plane, tolerance);
  double least = 1.0;
  for (size_t i = 0; i < 4; ++i) {
    int seen = 0;
    for (int k = 0; k < kPlaces; ++k) {
      const double t = (k + 0.5) / kPlaces;
      if (on_plane.Near((1.0 - t) * p_KV[i] + t * p_KV[(i + 1) % 4])) ++seen;
    }
    least = std::min(least, seen / static_cast<double>(kPlaces));
  }
  return least;
}

}  // namespace fenestra
