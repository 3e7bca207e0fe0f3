#include "vision/frame/detection/darkness.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr int kPlaces = 16;
constexpr double kExceptions = 0.125;
constexpr double kNearCornerShare =
    0.06;  // Left out at each end, where the neighbouring sides begin.
const double kFullContrast = std::log(4.0);

// Returns -1 outside the image.
double Grey(const cv::Mat1b& image, const Vector2d& p) {
  const int u = static_cast<int>(std::lround(p.x()));
  const int v = static_cast<int>(std::lround(p.y()));
  if (u < 0 || v < 0 || u >= image.cols || v >= image.rows) return -1.0;
  return image(v, u);
}

// Mean grey values above the black level on either side of an edge; nullopt outside the image.
struct GreyPair {
  double dark;
  double bright;
};
std::optional<GreyPair> GreysAt(const cv::Mat1b& image, const Vector2d& p, const Vector2d& right,
                                const DarknessSettings& settings) {
  const double near = 0.5 * settings.reach_px;
  const double far = settings.reach_px;
  const double dark_a = Grey(image, p + near * right);
  const double dark_b = Grey(image, p + far * right);
  const double bright_a = Grey(image, p - near * right);
  const double bright_b = Grey(image, p - far * right);
  if (std::min({dark_a, dark_b, bright_a, bright_b}) < 0.0) return std::nullopt;
  return GreyPair{0.5 * (dark_a + dark_b) - settings.black_dn,
                  0.5 * (bright_a + bright_b) - settings.black_dn};
}

// Calls `use` with the grey values at each place along a line.
template <typename Use>
void AlongLine(const cv::Mat1b& image, const Vector2d& from, const Vector2d& to,
               const DarknessSettings& settings, Use use) {
  const Vector2d along = to - from;
  const Vector2d right = Vector2d(-along.y(), along.x()).normalized();
  for (int i = 0; i < kPlaces; ++i) {
    const double share = kNearCornerShare + (1.0 - 2.0 * kNearCornerShare) * (i + 0.5) / kPlaces;
    if (const auto greys = GreysAt(image, from + share * along, right, settings)) use(*greys);
  }
}

}  // namespace

double DarkOnTheRight(const cv::Mat1b& image, const Vector2d& from, const Vector2d& to,
                      const DarknessSettings& settings) {
  double sum = 0.0;
  AlongLine(image, from, to, settings, [&](const GreyPair& greys) {
    if (greys.bright - greys.dark < settings.min_contrast_dn) return;
    sum += std::min(1.0, std::log(greys.bright / std::max(1.0, greys.dark)) / kFullContrast);
  });
  return sum / kPlaces;
}

double DarkOverBright(const cv::Mat1b& image, const std::vector<Vector2d>& outline,
                      const DarknessSettings& settings) {
  std::vector<double> ratios;
  for (size_t i = 0; i < outline.size(); ++i) {
    AlongLine(image, outline[i], outline[(i + 1) % outline.size()], settings,
              [&](const GreyPair& greys) {
                ratios.push_back(std::max(0.0, greys.dark) / std::max(1.0, greys.bright));
              });
  }
  if (ratios.empty()) return 1.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

bool IsDarkThroughout(const cv::Mat1b& image, const Quadrilateral& corners_px,
                      const DarknessSettings& settings) {
  std::vector<double> dark;
  std::vector<double> bright;
  for (size_t i = 0; i < 4; ++i) {
    AlongLine(image, corners_px[i], corners_px[(i + 1) % 4], settings, [&](const GreyPair& greys) {
      dark.push_back(greys.dark);
      bright.push_back(greys.bright);
    });
  }
  if (dark.empty()) return false;
  const auto exceptions = static_cast<std::ptrdiff_t>(kExceptions * dark.size());
  std::nth_element(dark.begin(), dark.end() - 1 - exceptions, dark.end());
  std::nth_element(bright.begin(), bright.begin() + exceptions, bright.end());
  return *(dark.end() - 1 - exceptions) < *(bright.begin() + exceptions);
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
