#include "sim/camera/image_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

const cv::Size kSize(400, 400);
constexpr double kPixels = 400.0 * 400.0;
constexpr ExposureSetting kMillisecond{.exposure_s = 1e-3, .gain = 1.0};

// Only temporal noise, of known size, without a fixed pattern and linear; 14 bits hide no electron.
ImageSensorOptions Fine() {
  ImageSensorOptions options;
  options.linear_range = 1.0;
  options.read_noise_e = 25.0;
  options.dark_current_e_s = 0.0;
  options.row_noise_e = 0.0;
  options.fixed_pattern = false;
  options.adc_bits = 14;
  options.output_bits = 14;
  options.black_level_dn = 400.0;
  return options;
}

struct MeanAndVariance {
  double mean;
  double variance;
};

MeanAndVariance Statistics(const cv::Mat& image) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(image, mean, deviation);
  return {mean[0], deviation[0] * deviation[0]};
}

// One frame of uniform light, in electrons above black.
MeanAndVariance Frame(const ImageSensorOptions& options, double electrons, uint64_t frame,
                      const ExposureSetting& exposure = kMillisecond) {
  const ImageSensor sensor(options, kSize, RandomStream(1));
  const cv::Mat1f light(kSize, static_cast<float>(electrons / exposure.exposure_s));
  const MeanAndVariance dn = Statistics(sensor.Expose(light, exposure, RandomStream(frame)));
  const double dn_per_e = sensor.DnPerElectron(exposure.gain);
  return {(dn.mean - sensor.BlackLevelDn()) / dn_per_e, dn.variance / (dn_per_e * dn_per_e)};
}

TEST(ImageSensorTest, VarianceIsShotNoisePlusReadNoise) {
  // EMVA 1288: σ² = μ_e + σ_d² + σ_q²/K². The variance of n normal samples has a relative standard
  // deviation of √(2/n); six of them are exceeded with probability 2e-9.
  const ImageSensorOptions sensor = Fine();
  const double tolerance = 6.0 * std::sqrt(2.0 / kPixels);
  const double read_e2 = sensor.read_noise_e * sensor.read_noise_e;
  for (const double mean_e : {0.0, 160.0, 1600.0, 8000.0, 12800.0}) {
    const MeanAndVariance found = Frame(sensor, mean_e, 5);
    const double variance_e2 = mean_e + read_e2;
    EXPECT_NEAR(found.mean, mean_e, 6.0 * std::sqrt(variance_e2 / kPixels));
    EXPECT_NEAR(found.variance / variance_e2, 1.0, tolerance) << mean_e;
    // The twin: a sensor without shot noise would be found out wherever there is light.
    if (mean_e >= 160.0) {
      EXPECT_GT(std::abs(found.variance / read_e2 - 1.0), tolerance);
    }
  }
}

TEST(ImageSensorTest, FewElectronsAreSkewedAsPoissonHasIt) {
  // Without read noise: skewness 1/√μ. Its standard error is √(6/n) = 0.006 at n = 160,000; more
  // for a skewed law. The expansion's own error is of the order of its third term, μ^-3/2/10.
  ImageSensorOptions options = Fine();
  options.read_noise_e = 0.0;
  options.saturation_e = 500.0;
  for (const double mean_e : {9.0, 25.0, 100.0}) {
    const ImageSensor sensor(options, kSize, RandomStream(1));
    const cv::Mat1f light(kSize, static_cast<float>(mean_e / 1e-3));
    cv::Mat1d dn;
    sensor.Expose(light, kMillisecond, RandomStream(7)).convertTo(dn, CV_64F);
    const MeanAndVariance s = Statistics(dn);
    cv::Mat1d cubes;
    cv::pow(dn - s.mean, 3.0, cubes);
    const double skewness = cv::mean(cubes)[0] / std::pow(s.variance, 1.5);
    EXPECT_NEAR(skewness, 1.0 / std::sqrt(mean_e), 0.04 + 0.1 * std::pow(mean_e, -1.5)) << mean_e;
    EXPECT_NEAR(s.variance / std::pow(sensor.DnPerElectron(1.0), 2) / mean_e, 1.0,
                6.0 * std::sqrt(2.5 / kPixels));
  }
}

TEST(ImageSensorTest, GainMultipliesSignalAndNoise) {
  const ImageSensorOptions options = Fine();
  const MeanAndVariance found = Frame(options, 2000.0, 3, {.exposure_s = 1e-3, .gain = 4.0});
  EXPECT_NEAR(found.mean, 2000.0, 6.0 * std::sqrt(2625.0 / kPixels));
  EXPECT_NEAR(found.variance / 2625.0, 1.0, 6.0 * std::sqrt(2.0 / kPixels));
  // A quarter of the electrons fills the range.
  EXPECT_LT(Frame(options, 1e5, 3, {.exposure_s = 1e-3, .gain = 4.0}).mean,
            1.01 * options.saturation_e / 4.0);
}

TEST(ImageSensorTest, DarkCurrentDoublesWithItsTemperatureStep) {
  ImageSensorOptions options = Fine();
  options.dark_current_e_s = 1000.0;
  options.temperature_c = 25.0;
  const ExposureSetting second{.exposure_s = 1.0, .gain = 1.0};
  EXPECT_NEAR(Frame(options, 0.0, 2, second).mean, 1000.0, 6.0 * std::sqrt(1625.0 / kPixels));
  options.temperature_c = 25.0 + 2.0 * options.dark_current_doubling_k;
  const MeanAndVariance hot = Frame(options, 0.0, 2, second);
  EXPECT_NEAR(hot.mean, 4000.0, 6.0 * std::sqrt(4625.0 / kPixels));
  EXPECT_NEAR(hot.variance / 4625.0, 1.0, 6.0 * std::sqrt(2.0 / kPixels));
}

TEST(ImageSensorTest, ThePatternBelongsToTheCameraAndTheNoiseToTheFrame) {
  ImageSensorOptions options = Fine();
  options.fixed_pattern = true;
  options.prnu = 0.02;
  options.dsnu_e = 30.0;
  const ImageSensor camera(options, kSize, RandomStream(1));
  const ImageSensor other(options, kSize, RandomStream(2));
  const cv::Mat1f light(kSize, static_cast<float>(5000.0 / 1e-3));
  const auto image = [&](const ImageSensor& sensor, uint64_t frame) {
    cv::Mat1f dn;
    sensor.Expose(light, kMillisecond, RandomStream(frame)).convertTo(dn, CV_32F);
    return dn;
  };
  const double e2 = std::pow(camera.DnPerElectron(1.0), 2);
  // Two frames of one camera differ by twice the temporal variance, those of two cameras by twice
  // the pattern's as well: (0.02 · 5000)² + 30².
  const double temporal = 5000.0 + 625.0;
  const double pattern = 100.0 * 100.0 + 900.0;
  const double same = Statistics(image(camera, 1) - image(camera, 2)).variance / e2;
  const double different = Statistics(image(camera, 1) - image(other, 2)).variance / e2;
  const double tolerance = 6.0 * std::sqrt(2.0 / kPixels);
  EXPECT_NEAR(same / (2.0 * temporal), 1.0, tolerance);
  EXPECT_NEAR(different / (2.0 * (temporal + pattern)), 1.0, tolerance);
}

TEST(ImageSensorTest, RowNoiseIsSharedByARowAndNewInEachFrame) {
  ImageSensorOptions options = Fine();
  options.row_noise_e = 50.0;
  const ImageSensor sensor(options, {400, 4000}, RandomStream(1));
  const cv::Mat1f dark = cv::Mat1f::zeros(4000, 400);
  const auto row_means = [&](uint64_t frame) {
    cv::Mat1f dn;
    sensor.Expose(dark, kMillisecond, RandomStream(frame)).convertTo(dn, CV_32F);
    cv::Mat1f means;
    cv::reduce(dn, means, 1, cv::REDUCE_AVG);
    return cv::Mat1f(means / sensor.DnPerElectron(1.0));
  };
  // 50² plus the mean of 400 pixels' read noise, 25²/400.
  const double expected = 2500.0 + 625.0 / 400.0;
  const double tolerance = 6.0 * std::sqrt(2.0 / 4000.0);
  EXPECT_NEAR(Statistics(row_means(1)).variance / expected, 1.0, tolerance);
  EXPECT_NEAR(Statistics(row_means(1) - row_means(2)).variance / (2.0 * expected), 1.0, tolerance);
}

TEST(ImageSensorTest, OutputIsTheAdcsUpperBits) {
  ImageSensorOptions options;
  options.linear_range = 1.0;
  options.black_level_dn = 32.0;
  options.noise = false;
  options.fixed_pattern = false;
  options.output_bits = 10;
  ImageSensorOptions eight = options;
  eight.output_bits = 8;
  cv::Mat1f ramp(1, 2000);
  for (int u = 0; u < ramp.cols; ++u) ramp(0, u) = static_cast<float>(u) * 10.0f / 1e-3f;
  const cv::Mat1w ten = ImageSensor(options, ramp.size(), RandomStream(1))
                            .Expose(ramp, kMillisecond, RandomStream(1));
  const cv::Mat1w upper =
      ImageSensor(eight, ramp.size(), RandomStream(1)).Expose(ramp, kMillisecond, RandomStream(1));
  for (int u = 0; u < ramp.cols; ++u) EXPECT_EQ(upper(0, u), ten(0, u) / 4);
  EXPECT_EQ(ten(0, 0), 32);
  EXPECT_EQ(ten(0, 1999), 1023);  // Saturated.
  EXPECT_EQ(ten(0, 1601), 1023);
  EXPECT_LT(ten(0, 1595), 1023);
}

TEST(ImageSensorTest, PhotonTransferIsThatOfRecordedImages) {
  // What 8-bit images of the MT9V034 show, at a gain of 2: a variance of 0.5 DN² at 12 DN that
  // grows by 0.03 DN²/DN up to 170 DN and is flat beyond. The recorded figures are rounded.
  ImageSensorOptions options;
  options.fixed_pattern = false;
  const ImageSensor sensor(options, kSize, RandomStream(1));
  const ExposureSetting exposure{.exposure_s = 1e-3, .gain = 2.0};
  const auto variance_at = [&](double dn) {
    // Light that a linear sensor would show at this value: the shoulder begins at 170 DN.
    const double electrons = (dn - sensor.BlackLevelDn()) / sensor.DnPerElectron(2.0);
    const cv::Mat1f light(kSize, static_cast<float>(electrons / exposure.exposure_s));
    return Statistics(sensor.Expose(light, exposure, RandomStream(11))).variance;
  };
  EXPECT_NEAR(variance_at(12.0), 0.5, 0.1);
  EXPECT_NEAR((variance_at(160.0) - variance_at(20.0)) / 140.0, 0.03, 0.003);
  for (const double dn : {190.0, 220.0, 245.0}) {
    EXPECT_NEAR(variance_at(dn) / variance_at(165.0), 1.0, 0.05) << dn;
  }
}

TEST(ImageSensorTest, TheResponseBendsSmoothlyAndNeverFalls) {
  ImageSensorOptions options = Fine();
  options.noise = false;
  options.linear_range = 0.6;
  const double range_dn = 16383.0 - options.black_level_dn;
  const double full_e = ImageSensor(options, kSize, RandomStream(1)).FullScaleElectrons(1.0);
  cv::Mat1f ramp(1, 2001);
  for (int u = 0; u < ramp.cols; ++u) {
    ramp(0, u) = static_cast<float>(1.1 * full_e * u / 2000.0 / 1e-3);
  }
  const cv::Mat1w dn = ImageSensor(options, ramp.size(), RandomStream(1))
                           .Expose(ramp, kMillisecond, RandomStream(1));
  for (int u = 0; u < ramp.cols; ++u) {
    const double x = 1.1 * full_e * u / 2000.0 / options.saturation_e;
    const double bent = x <= 0.6 ? x : 2.0 * std::sqrt(0.6 * x) - 0.6;
    const double expected = options.black_level_dn + range_dn * std::min(bent, 1.0);
    EXPECT_NEAR(dn(0, u), expected, 0.51) << x;
  }
  // Full scale is reached where the sensor says, and the slope nowhere jumps.
  EXPECT_EQ(dn(0, 1819), 16383);
  EXPECT_LT(dn(0, 1816), 16383);
}

TEST(ImageSensorTest, AutomaticExposureTakesTimeFirstAndGainThen) {
  const ImageSensorOptions sensor;
  const ExposureOptions exposure{.automatic = true, .set_point = 0.35};
  const double full_in_1ms = 0.35 * sensor.saturation_e / 1e-3;
  EXPECT_NEAR(ChooseExposure(exposure, sensor, full_in_1ms).exposure_s, 1e-3, 1e-12);
  EXPECT_EQ(ChooseExposure(exposure, sensor, full_in_1ms).gain, 1.0);
  EXPECT_EQ(ChooseExposure(exposure, sensor, 1e12).exposure_s, exposure.shortest_s);
  // Half of what the longest exposure needs: twice the gain.
  const double dim = 0.5 * 0.35 * sensor.saturation_e / exposure.longest_s;
  EXPECT_EQ(ChooseExposure(exposure, sensor, dim).exposure_s, exposure.longest_s);
  EXPECT_NEAR(ChooseExposure(exposure, sensor, dim).gain, 2.0, 1e-12);
  EXPECT_EQ(ChooseExposure(exposure, sensor, 0.0).exposure_s, exposure.longest_s);
  EXPECT_EQ(ChooseExposure(exposure, sensor, 0.0).gain, exposure.largest_gain);
}

TEST(ImageSensorTest, AbsurdFiguresAreRefusedAllAtOnce) {
  ImageSensorOptions options;
  options.saturation_e = 0.0;
  options.output_bits = 12;
  options.black_level_dn = 5000.0;
  try {
    ImageSensor sensor(options, kSize, RandomStream(1));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3u);
  }
}

}  // namespace
}  // namespace fenestra
