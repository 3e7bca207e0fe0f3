#include "sim/image_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/check.h"

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

}  // namespace

double IlluminancePerLuminance(const LensOptions& lens) {
  return std::numbers::pi * lens.transmission / (4.0 * lens.f_number * lens.f_number);
}

cv::Mat1f NaturalVignetting(const RayGrid& rays) {
  cv::Mat1f cos4(rays.height_px(), rays.width_px());
  for (int v = 0; v < cos4.rows; ++v) {
    for (int u = 0; u < cos4.cols; ++u) {
      const Eigen::Vector2f n = 0.25f * (rays.Corner(u, v) + rays.Corner(u + 1, v) +
                                         rays.Corner(u, v + 1) + rays.Corner(u + 1, v + 1));
      const float inverse_cos2 = 1.0f + n.squaredNorm();
      cos4(v, u) = 1.0f / (inverse_cos2 * inverse_cos2);
    }
  }
  return cos4;
}

double ChooseExposure(const ExposureOptions& exposure, const ImageSensorOptions& sensor,
                      const LensOptions& lens, double mean_luminance) {
  if (!exposure.automatic) return exposure.exposure_s;
  const double electrons_per_s =
      sensor.electrons_per_lux_s * IlluminancePerLuminance(lens) * mean_luminance;
  const double wanted_s = exposure.set_point * sensor.saturation_e / electrons_per_s;
  // Written so that darkness (a division by zero) gives the longest time.
  return std::max(exposure.shortest_s, std::min(exposure.longest_s, wanted_s));
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

cv::Mat BlurByLens(const cv::Mat& radiance, const LensOptions& lens) {
  const std::vector<float> taps = GaussianTaps(lens.blur_sigma_px);
  cv::Mat blurred;
  cv::sepFilter2D(radiance, blurred, radiance.depth(), taps, taps, cv::Point(-1, -1), 0.0,
                  cv::BORDER_REPLICATE);
  return blurred;
}

cv::Mat1f Expose(const cv::Mat1f& luminance, const ImageSensorOptions& sensor,
                 const LensOptions& lens, double exposure_s, const RandomStream& noise) {
  const float electrons_per_luminance =
      static_cast<float>(sensor.electrons_per_lux_s * IlluminancePerLuminance(lens) * exposure_s);
  const float inverse_saturation = static_cast<float>(1.0 / sensor.saturation_e);
  const float read_variance = static_cast<float>(sensor.read_noise_e * sensor.read_noise_e);

  cv::Mat1f signal = cv::Mat1f::zeros(luminance.size());
  if (sensor.noise) noise.FillNormals({signal.ptr<float>(), signal.total()});
  for (int v = 0; v < signal.rows; ++v) {
    const float* in = luminance[v];
    float* out = signal[v];
    for (int u = 0; u < signal.cols; ++u) {
      const float mean_e = electrons_per_luminance * in[u];
      const float electrons = mean_e + std::sqrt(mean_e + read_variance) * out[u];
      out[u] = std::clamp(electrons * inverse_saturation, 0.0f, 1.0f);
    }
  }
  return signal;
}

}  // namespace fenestra
