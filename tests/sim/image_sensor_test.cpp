#include "sim/image_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

// Luminance that fills the given fraction of saturation in 1 ms.
double LuminanceFor(double fraction, const ImageSensorOptions& sensor, const LensOptions& lens) {
  return fraction * sensor.saturation_e /
         (sensor.electrons_per_lux_s * IlluminancePerLuminance(lens) * 1e-3);
}

struct MeanAndVariance {
  double mean;
  double variance;
};

MeanAndVariance Statistics(const cv::Mat1f& image) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(image, mean, deviation);
  return {mean[0], deviation[0] * deviation[0]};
}

TEST(ImageSensorTest, SignalIsProportionalToLightTimeAndInverseSquareOfTheAperture) {
  ImageSensorOptions sensor;
  sensor.noise = false;
  LensOptions lens{.f_number = 2.8};
  const cv::Mat1f image(4, 4, static_cast<float>(LuminanceFor(0.2, sensor, lens)));
  const RandomStream stream(1);
  EXPECT_NEAR(Expose(image, sensor, lens, 1e-3, stream)(0, 0), 0.2, 1e-6);
  EXPECT_NEAR(Expose(image, sensor, lens, 2e-3, stream)(0, 0), 0.4, 1e-6);
  lens.f_number = 5.6;
  EXPECT_NEAR(Expose(image, sensor, lens, 1e-3, stream)(0, 0), 0.05, 1e-6);
  EXPECT_EQ(Expose(image, sensor, lens, 1.0, stream)(0, 0), 1.0f);  // Saturated.
}

TEST(ImageSensorTest, VarianceIsShotNoisePlusReadNoise) {
  // EMVA 1288: σ² = μ_e + σ_d². The variance of n normal samples has a relative standard deviation
  // of √(2/n); six of them are exceeded with probability 2e-9.
  const ImageSensorOptions sensor;
  const LensOptions lens;
  const int n = 400 * 400;
  const double tolerance = 6.0 * std::sqrt(2.0 / n);
  for (const double fraction : {0.01, 0.1, 0.5, 0.8}) {
    const cv::Mat1f image(400, 400, static_cast<float>(LuminanceFor(fraction, sensor, lens)));
    const MeanAndVariance s = Statistics(Expose(image, sensor, lens, 1e-3, RandomStream(5)));
    const double mean_e = fraction * sensor.saturation_e;
    const double variance_e = mean_e + sensor.read_noise_e * sensor.read_noise_e;
    const double observed_e = s.variance * sensor.saturation_e * sensor.saturation_e;
    EXPECT_NEAR(s.mean, fraction, 6.0 * std::sqrt(variance_e / n) / sensor.saturation_e);
    EXPECT_NEAR(observed_e / variance_e, 1.0, tolerance) << fraction;
    // The twin: a sensor without shot noise would be found out wherever there is light.
    if (fraction >= 0.1) {
      EXPECT_GT(std::abs(sensor.read_noise_e * sensor.read_noise_e / observed_e - 1.0), tolerance);
    }
  }
}

TEST(ImageSensorTest, AutomaticExposureMeetsItsSetPointWithinItsLimits) {
  const ImageSensorOptions sensor;
  const LensOptions lens;
  const ExposureOptions exposure{.automatic = true, .set_point = 0.35};
  const double luminance = LuminanceFor(0.35, sensor, lens);
  EXPECT_NEAR(ChooseExposure(exposure, sensor, lens, luminance), 1e-3, 1e-12);
  EXPECT_EQ(ChooseExposure(exposure, sensor, lens, 1e9), exposure.shortest_s);
  EXPECT_EQ(ChooseExposure(exposure, sensor, lens, 0.0), exposure.longest_s);
}

TEST(ImageSensorTest, BlurTapsHaveTheVarianceThatTheyAreAskedFor) {
  for (const double sigma_px : {0.2, 0.45, 0.7, 1.5, 4.0}) {
    const std::vector<float> taps = GaussianTaps(sigma_px);
    const int reach = static_cast<int>(taps.size()) / 2;
    double sum = 0.0;
    double variance = 0.0;
    for (int i = -reach; i <= reach; ++i) {
      sum += taps[static_cast<size_t>(i + reach)];
      variance += taps[static_cast<size_t>(i + reach)] * i * i;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_NEAR(variance, sigma_px * sigma_px, 1e-5 * sigma_px * sigma_px + 1e-6);
  }
}

TEST(ImageSensorTest, VignettingIsTheFourthPowerOfTheCosine) {
  const CameraModel camera = CameraModel::Pinhole(201, 101, 100.0);
  const cv::Mat1f vignetting = NaturalVignetting(RayGrid(camera));
  EXPECT_NEAR(vignetting(50, 100), 1.0, 1e-6);
  EXPECT_NEAR(vignetting(50, 200), std::pow(std::cos(std::numbers::pi / 4), 4), 1e-6);
}

}  // namespace
}  // namespace fenestra
