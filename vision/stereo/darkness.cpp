#include "vision/stereo/darkness.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr int kPlaces = 16;
constexpr double kEndShare = 0.06;  // Left out at each end, where other sides begin.
const double kFullContrast = std::log(4.0);

// -1 outside the image.
double Grey(const cv::Mat1b& image, const Vector2d& p) {
  const int u = static_cast<int>(std::lround(p.x()));
  const int v = static_cast<int>(std::lround(p.y()));
  if (u < 0 || v < 0 || u >= image.cols || v >= image.rows) return -1.0;
  return image(v, u);
}

double DarkAt(const cv::Mat1b& image, const Vector2d& p, const Vector2d& right,
              const DarknessSettings& settings) {
  const double near = 0.5 * settings.reach_px;
  const double far = settings.reach_px;
  const double dark_a = Grey(image, p + near * right);
  const double dark_b = Grey(image, p + far * right);
  const double bright_a = Grey(image, p - near * right);
  const double bright_b = Grey(image, p - far * right);
  if (std::min({dark_a, dark_b, bright_a, bright_b}) < 0.0) return 0.0;
  const double dark = 0.5 * (dark_a + dark_b) - settings.black_dn;
  const double bright = 0.5 * (bright_a + bright_b) - settings.black_dn;
  if (bright - dark < settings.min_contrast_dn) return 0.0;
  return std::min(1.0, std::log(bright / std::max(1.0, dark)) / kFullContrast);
}

}  // namespace

double DarkOnTheRight(const cv::Mat1b& image, const Vector2d& from, const Vector2d& to,
                      const DarknessSettings& settings) {
  const Vector2d along = to - from;
  const Vector2d right = Vector2d(-along.y(), along.x()).normalized();
  double sum = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    const double share = kEndShare + (1.0 - 2.0 * kEndShare) * (i + 0.5) / kPlaces;
    sum += DarkAt(image, from + share * along, right, settings);
  }
  return sum / kPlaces;
}

double DarkInside(const cv::Mat1b& image, const Quadrilateral& corners_px,
                  const DarknessSettings& settings) {
  double sum = 0.0;
  for (size_t i = 0; i < 4; ++i) {
    sum += DarkOnTheRight(image, corners_px[i], corners_px[(i + 1) % 4], settings);
  }
  return 0.25 * sum;
}

}  // namespace fenestra
