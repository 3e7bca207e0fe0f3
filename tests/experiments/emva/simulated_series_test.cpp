#include "experiments/emva/simulated_series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace fenestra::emva {
namespace {

SimulationOptions ShortSeries() {
  return {.size = {64, 48}, .exposures = 10, .frames = 5};
}

ImageSensorOptions TenBitSensor() {
  ImageSensorOptions sensor;
  sensor.linear_range = 1.0;
  sensor.output_bits = 10;
  return sensor;
}

const ImageSet& Stack(const Series& series, bool dark) {
  for (const ImageSet& set : series.sets) {
    if (set.is_spatial() && set.is_dark() == dark) return set;
  }
  throw std::logic_error("no stack");
}

double MeanOf(const cv::Mat1w& frame) {
  return cv::mean(frame)[0];
}

TEST(SimulatedSeries, HasAPairInLightAndDarkAtEachExposureAndTwoStacks) {
  const Series series = PlanSeries(ShortSeries(), TenBitSensor());
  EXPECT_EQ(series.bits, 10);
  EXPECT_EQ(series.size, cv::Size(64, 48));
  ASSERT_EQ(series.sets.size(), 2u * 10u + 2u);
  std::set<std::string> names;
  for (size_t i = 0; i < 10; ++i) {
    const ImageSet& bright = series.sets[2 * i];
    const ImageSet& dark = series.sets[2 * i + 1];
    EXPECT_EQ(bright.exposure_s, dark.exposure_s);
    EXPECT_NEAR(bright.exposure_s, 2e-3 * static_cast<double>(i + 1), 1e-9);
    EXPECT_FALSE(bright.is_dark());
    EXPECT_TRUE(dark.is_dark());
  }
  for (const ImageSet& set : series.sets) {
    EXPECT_EQ(set.files.size(), set.is_spatial() ? 5u : 2u);
    names.insert(set.files.begin(), set.files.end());
  }
  EXPECT_EQ(names.size(), 2u * 2u * 10u + 2u * 5u) << "two frames share a file";
}

TEST(SimulatedSeries, LightIsConstantAndEndsBeyondSaturation) {
  const SimulationOptions options = ShortSeries();
  const ImageSensorOptions sensor = TenBitSensor();
  const Series series = PlanSeries(options, sensor);
  const double per_s = series.sets[0].photons / series.sets[0].exposure_s;
  for (const ImageSet& set : series.sets) {
    if (set.is_dark()) continue;
    EXPECT_NEAR(set.photons / set.exposure_s, per_s, 1e-9 * per_s);
  }
  const double most_e = options.quantum_efficiency * series.sets[18].photons;
  EXPECT_NEAR(most_e, 1.08 * sensor.saturation_e, 1e-9 * most_e);
  // The standard's place for spatial figures; exposures are whole microseconds.
  EXPECT_NEAR(options.quantum_efficiency * Stack(series, false).photons, 0.5 * sensor.saturation_e,
              1e-3 * sensor.saturation_e);
}

TEST(SimulatedSeries, ExposuresAreWholeMicroseconds) {
  SimulationOptions options = ShortSeries();
  options.exposures = 11;
  options.longest_exposure_s = 1e-3;
  for (const ImageSet& set : PlanSeries(options, TenBitSensor()).sets) {
    EXPECT_NEAR(1e6 * set.exposure_s, std::round(1e6 * set.exposure_s), 1e-6);
    EXPECT_GE(set.exposure_s, 1e-6);
  }
}

TEST(SimulatedSeries, AFramesMeanIsThatOfItsPhotons) {
  const SimulationOptions options = ShortSeries();
  const ImageSensorOptions sensor = TenBitSensor();
  const Series series = PlanSeries(options, sensor);
  const ImageReader frames = Simulate(options, sensor, RandomStream(1));
  const PutIn put_in = PutInBy(options, sensor);
  const ImageSet& bright = Stack(series, false);
  const ImageSet& dark = Stack(series, true);
  const double electrons = options.quantum_efficiency * bright.photons;
  const double signal_dn = MeanOf(frames(bright, 0)) - MeanOf(frames(dark, 0));
  // 3072 pixels whose sensitivities differ by 1.5 %, and shot noise of √8000 = 90 e, which is 1.1
  // %: 1.9 % over √3072, five times.
  EXPECT_NEAR(signal_dn / (put_in.gain_dn_per_e * electrons), 1.0, 0.0017);
}

TEST(SimulatedSeries, AFrameIsAFunctionOfItsSetAndNumber) {
  const SimulationOptions options = ShortSeries();
  const Series series = PlanSeries(options, TenBitSensor());
  const ImageReader once = Simulate(options, TenBitSensor(), RandomStream(1));
  const ImageReader again = Simulate(options, TenBitSensor(), RandomStream(1));
  const ImageReader other = Simulate(options, TenBitSensor(), RandomStream(2));
  const auto differing = [](const cv::Mat1w& a, const cv::Mat1w& b) {
    return cv::countNonZero(a != b);
  };
  const ImageSet& set = Stack(series, false);
  EXPECT_EQ(differing(once(set, 3), again(set, 3)), 0);
  const int most = options.size.area();
  EXPECT_GT(differing(once(set, 3), once(set, 4)), most / 2);
  EXPECT_GT(differing(once(set, 3), other(set, 3)), most / 2);
  EXPECT_GT(differing(once(series.sets[0], 0), once(series.sets[2], 0)), most / 2);
}

TEST(SimulatedSeries, FramesOfAStackShareTheCamerasPattern) {
  const SimulationOptions options = ShortSeries();
  ImageSensorOptions sensor = TenBitSensor();
  sensor.noise = false;
  const Series series = PlanSeries(options, sensor);
  const ImageReader frames = Simulate(options, sensor, RandomStream(1));
  const ImageSet& set = Stack(series, false);
  EXPECT_EQ(cv::countNonZero(frames(set, 0) != frames(set, 1)), 0);
  sensor.fixed_pattern = false;
  const cv::Mat1w flat = Simulate(options, sensor, RandomStream(1))(set, 0);
  EXPECT_EQ(cv::countNonZero(flat != flat(0, 0)), 0);
}

TEST(SimulatedSeries, FiguresThatAreSwitchedOffAreNought) {
  ImageSensorOptions sensor = TenBitSensor();
  const PutIn all = PutInBy(ShortSeries(), sensor);
  EXPECT_EQ(all.dark_noise_e, std::hypot(sensor.read_noise_e, sensor.row_noise_e));
  EXPECT_EQ(all.dsnu_e, sensor.dsnu_e);
  EXPECT_EQ(all.prnu, sensor.prnu);
  sensor.noise = false;
  sensor.fixed_pattern = false;
  const PutIn none = PutInBy(ShortSeries(), sensor);
  EXPECT_EQ(none.dark_noise_e, 0.0);
  EXPECT_EQ(none.dsnu_e, 0.0);
  EXPECT_EQ(none.prnu, 0.0);
}

// Where the variance is largest: with equal pixels, two or three standard deviations, 126 e at
// 16000 e, before full scale; pixels of different sensitivity are clipped earlier.
TEST(SimulatedSeries, SaturationIsWherePixelsBeginToBeClipped) {
  ImageSensorOptions sensor = TenBitSensor();
  const double uneven_e = PutInBy(ShortSeries(), sensor).saturation_e.value();
  sensor.fixed_pattern = false;
  const double even_e = PutInBy(ShortSeries(), sensor).saturation_e.value();
  EXPECT_LT(even_e, sensor.saturation_e - 126.0);
  EXPECT_GT(even_e, sensor.saturation_e - 5.0 * 126.0);
  EXPECT_LT(uneven_e, even_e);
  SimulationOptions amplified = ShortSeries();
  amplified.gain = 4.0;
  EXPECT_LT(PutInBy(amplified, sensor).saturation_e.value(), even_e / 4.0);
}

TEST(SimulatedSeries, AWrittenSeriesReadsBackToTheBit) {
  for (const int bits : {8, 10}) {
    const SimulationOptions options{.size = {24, 16}, .exposures = 10, .frames = 3};
    ImageSensorOptions sensor;
    sensor.output_bits = bits;
    const Series series = PlanSeries(options, sensor);
    const ImageReader frames = Simulate(options, sensor, RandomStream(1));
    const fenestra::testing::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "images");
    const auto descriptor = WriteSeries(folder.path(), series, frames);
    const Series read = ReadDescriptor(descriptor);
    const ImageReader files = FilesBeside(descriptor, read);
    ASSERT_EQ(read.sets.size(), series.sets.size());
    EXPECT_EQ(read.bits, bits);
    for (size_t i = 0; i < series.sets.size(); ++i) {
      EXPECT_NEAR(read.sets[i].exposure_s, series.sets[i].exposure_s, 1e-15);
      for (size_t k = 0; k < series.sets[i].files.size(); ++k) {
        EXPECT_EQ(cv::countNonZero(files(read.sets[i], k) != frames(series.sets[i], k)), 0);
      }
    }
  }
}

TEST(SimulatedSeries, AllFaultsAreReportedAtOnce) {
  const SimulationOptions absurd{.size = {4, 48},
                                 .exposures = 2,
                                 .frames = 1,
                                 .gain = 0.0,
                                 .quantum_efficiency = 0.0,
                                 .longest_exposure_s = -1.0};
  try {
    Validate(absurd);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 6u) << error.what();
  }
}

}  // namespace
}  // namespace fenestra::emva
