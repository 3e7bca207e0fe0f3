#include "vision/rgbd/opening.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

constexpr double kShrink = 0.5;
constexpr int kFractionBits = 8;  // Of a pixel, in cv::fillConvexPoly.

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
  int filled = 0;
  for (const cv::Point& pixel : pixels) {
    const double z_m = cloud.depth_m(pixel);
    const auto ray_K = camera.UnprojectRay({pixel.x, pixel.y});
    if (!(z_m > 0.0) || !ray_K) continue;
    if (std::abs(plane.SignedDistance(z_m * *ray_K)) <= tolerance.At(z_m)) ++filled;
  }
  return pixels.empty() ? 0.0 : filled / static_cast<double>(pixels.size());
}

}  // namespace fenestra
