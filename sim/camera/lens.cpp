#include "sim/camera/lens.h"

#include <cmath>
#include <numbers>

#include "core/system/check.h"
#include "sim/camera/point_spread.h"

namespace fenestra {

double IlluminancePerLuminance(const LensOptions& lens) {
  return std::numbers::pi * lens.transmission / (4.0 * lens.f_number * lens.f_number);
}

cv::Mat1f RelativeIllumination(const RayGrid& rays, const LensOptions& lens) {
  cv::Mat1f relative(rays.height_px(), rays.width_px());
  const auto loss =
      static_cast<float>((1.0 - lens.corner_illumination) / SquaredHalfDiagonal(relative.size()));
  const cv::Point2f centre(0.5f * static_cast<float>(relative.cols - 1),
                           0.5f * static_cast<float>(relative.rows - 1));
  for (int v = 0; v < relative.rows; ++v) {
    for (int u = 0; u < relative.cols; ++u) {
      const Eigen::Vector2f n = 0.25f * (rays.Corner(u, v) + rays.Corner(u + 1, v) +
                                         rays.Corner(u, v + 1) + rays.Corner(u + 1, v + 1));
      const float inverse_cos2 = 1.0f + n.squaredNorm();
      const cv::Point2f offset = cv::Point2f(static_cast<float>(u), static_cast<float>(v)) - centre;
      relative(v, u) = (1.0f - loss * offset.dot(offset)) / (inverse_cos2 * inverse_cos2);
    }
  }
  return relative;
}

cv::Mat WithVeilingGlare(const cv::Mat& image, double glare) {
  FENESTRA_CHECK(glare >= 0.0 && glare <= 1.0, "veiling glare is a share of the light");
  cv::Mat veiled;
  image.convertTo(veiled, -1, 1.0 - glare);
  veiled += cv::mean(image) * glare;
  return veiled;
}

cv::Mat1f CirclesOfConfusion(const cv::Mat1f& inverse_distance, const Focus& focus) {
  const double px_per_m = 1.0 / (focus.f_number * focus.pixel_pitch_m);
  const double f2 = focus.focal_length_m * focus.focal_length_m;
  const Eigen::Vector2d slope_px = focus.tilt_rad * focus.pixel_pitch_m * px_per_m;
  const Eigen::Vector2d centre(0.5 * (inverse_distance.cols - 1),
                               0.5 * (inverse_distance.rows - 1));
  cv::Mat1f confusion_px(inverse_distance.size());
  for (int v = 0; v < confusion_px.rows; ++v) {
    const auto per_diopter = static_cast<float>(f2 * px_per_m);
    const auto slope = static_cast<float>(slope_px.x());
    const auto first =
        static_cast<float>(slope_px.y() * (v - centre.y()) - slope_px.x() * centre.x() -
                           f2 * px_per_m / focus.distance_m);
    const float* in = inverse_distance[v];
    float* out = confusion_px[v];
    for (int u = 0; u < confusion_px.cols; ++u) {
      out[u] = std::abs(per_diopter * in[u] + slope * static_cast<float>(u) + first);
    }
  }
  return confusion_px;
}

}  // namespace fenestra
