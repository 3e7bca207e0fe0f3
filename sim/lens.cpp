#include "sim/lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/wide.h"

namespace fenestra {
namespace {

double DiscreteVariance(double sigma_px, int reach) {
  double sum = 1.0;
  double moment = 0.0;
  for (int i = 1; i <= reach; ++i) {
    const double weight = 2.0 * std::exp(-0.5 * i * i / (sigma_px * sigma_px));
    sum += weight;
    moment += weight * i * i;
  }
  return moment / sum;
}

// ρ² = 1 at the outer corners of the corner pixels.
double SquaredCornerDistance(cv::Size size) {
  return 0.25 * (static_cast<double>(size.width) * size.width +
                 static_cast<double>(size.height) * size.height);
}

// What a three-tap kernel does at each pixel of a row: variance a + b x², x from the centre.
struct RowVariance {
  float a;
  float b;
  float centre;
};

// out = in + variance/2 (before - 2 in + after).
FENESTRA_WIDE void Spread(const float* before, const float* in, const float* after, float* out,
                          int first, int last, const RowVariance& variance) {
  for (int u = first; u < last; ++u) {
    const float x = static_cast<float>(u) - variance.centre;
    const float half = 0.5f * (variance.a + variance.b * x * x);
    out[u] = in[u] + half * (before[u] - 2.0f * in[u] + after[u]);
  }
}

// One three-tap kernel along the rows and one along the columns, of variance peak ρ² each.
void SpreadOnce(cv::Mat1f& image, double peak) {
  const float b = static_cast<float>(peak / SquaredCornerDistance(image.size()));
  const float centre_u = 0.5f * static_cast<float>(image.cols - 1);
  const float centre_v = 0.5f * static_cast<float>(image.rows - 1);
  const auto variance_of_row = [&](int v) {
    const float y = static_cast<float>(v) - centre_v;
    return RowVariance{.a = b * y * y, .b = b, .centre = centre_u};
  };
  cv::Mat1f along_rows(image.size());
  const int last = image.cols - 1;
  for (int v = 0; v < image.rows; ++v) {
    const float* in = image[v];
    float* out = along_rows[v];
    const RowVariance variance = variance_of_row(v);
    Spread(in - 1, in, in + 1, out, 1, last, variance);
    if (last == 0) {
      out[0] = in[0];
      continue;
    }
    const float half = 0.5f * (variance.a + b * centre_u * centre_u);
    out[0] = in[0] + half * (in[1] - in[0]);
    out[last] = in[last] + half * (in[last - 1] - in[last]);
  }
  for (int v = 0; v < image.rows; ++v) {
    const float* before = along_rows[std::max(v - 1, 0)];
    const float* after = along_rows[std::min(v + 1, image.rows - 1)];
    Spread(before, along_rows[v], after, image[v], 0, image.cols, variance_of_row(v));
  }
}

}  // namespace

double IlluminancePerLuminance(const LensOptions& lens) {
  return std::numbers::pi * lens.transmission / (4.0 * lens.f_number * lens.f_number);
}

cv::Mat1f RelativeIllumination(const RayGrid& rays, const LensOptions& lens) {
  cv::Mat1f relative(rays.height_px(), rays.width_px());
  const auto loss =
      static_cast<float>((1.0 - lens.corner_illumination) / SquaredCornerDistance(relative.size()));
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

std::vector<float> GaussianTaps(double sigma_px) {
  FENESTRA_CHECK(sigma_px >= 0.0 && sigma_px <= 20.0, "blur must be between 0 and 20 px");
  if (sigma_px < 0.01) return {1.0f};
  const int reach = std::max(1, static_cast<int>(std::ceil(5.0 * sigma_px)));
  // Sampling a narrow Gaussian at whole pixels loses variance (0.45 px would act as 0.38 px): find
  // the one whose samples have the wanted variance.
  const double variance = sigma_px * sigma_px;
  double low = 0.05;
  double high = sigma_px + 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (DiscreteVariance(middle, reach) < variance ? low : high) = middle;
  }
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (high * high)));
    sum += weights.back();
  }
  std::vector<float> taps;
  for (const double weight : weights) taps.push_back(static_cast<float>(weight / sum));
  return taps;
}

cv::Mat1f Blur(const cv::Mat1f& image, const PointSpread& spread) {
  FENESTRA_CHECK(spread.corner_sigma_px >= spread.centre_sigma_px,
                 "an image is blurred least in its centre");
  const std::vector<float> taps = GaussianTaps(spread.centre_sigma_px);
  cv::Mat1f blurred;
  cv::sepFilter2D(image, blurred, CV_32F, taps, taps, cv::Point(-1, -1), 0.0, cv::BORDER_REPLICATE);
  const double rest = spread.corner_sigma_px * spread.corner_sigma_px -
                      spread.centre_sigma_px * spread.centre_sigma_px;
  // A three-tap kernel of variance 1/4 is close to a Gaussian; more of it takes several.
  constexpr double kLargestVariance = 0.25;
  const int passes = static_cast<int>(std::ceil(rest / kLargestVariance));
  for (int i = 0; i < passes; ++i) SpreadOnce(blurred, rest / passes);
  return blurred;
}

}  // namespace fenestra
