// The standard's figures of our own sensor are what was put in, and those of a faulty one are not.

#include "experiments/emva/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/io/input_error.h"
#include "experiments/emva/simulated_series.h"

namespace fenestra::emva {
namespace {

using ::testing::HasSubstr;

// 10-bit output, small images. With n = 48,000 pixels a pair's variance is known to √(2/n) = 0.65 %
// and the slope K over 35 of them to about 0.15 %; σ_d, from 50 dark pairs, to 0.1 %; DSNU and PRNU
// to √(1/2n) = 0.3 %. The tolerances below are more than ten standard deviations.
SimulationOptions Small() {
  return {.size = {240, 200}, .exposures = 50, .frames = 30};
}

// The standard's linear sensor: its saturation is where the variance is largest.
ImageSensorOptions LinearSensor() {
  ImageSensorOptions sensor;
  sensor.linear_range = 1.0;
  return sensor;
}

ImageSensorOptions TenBits() {
  ImageSensorOptions sensor = LinearSensor();
  sensor.output_bits = 10;
  return sensor;
}

constexpr double kGain = 0.02;
constexpr double kEfficiency = 0.02;
constexpr double kDarkNoise = 0.05;
constexpr double kUniformity = 0.10;
constexpr double kSaturation = 0.03;

using Fault = std::function<void(cv::Mat1w&, const ImageSet&, size_t)>;

struct Measured {
  Results results;
  PutIn put_in;

  double Gain() const { return results.gain_dn_per_e / put_in.gain_dn_per_e - 1.0; }
  double Efficiency() const { return results.quantum_efficiency / put_in.quantum_efficiency - 1.0; }
  double DarkNoise() const { return results.dark_noise_e / put_in.dark_noise_e - 1.0; }
  double Dsnu() const { return results.dsnu_e.total / put_in.dsnu_e - 1.0; }
  double Prnu() const { return results.prnu.total / put_in.prnu - 1.0; }
  double Saturation() const { return results.saturation_e / put_in.saturation_e.value() - 1.0; }
};

// Takes the series with `taken`, compares with `told`.
Measured Measure(const SimulationOptions& options, const ImageSensorOptions& told,
                 const ImageSensorOptions& taken, const Fault& fault = {}) {
  const Series series = PlanSeries(options, told);
  const ImageReader sound = Simulate(options, taken, RandomStream(5));
  const auto images = [&](const ImageSet& set, size_t i) {
    cv::Mat1w image = sound(set, i);
    if (fault) fault(image, set, i);
    return image;
  };
  return {Evaluate(series, images), PutInBy(options, told)};
}

void ExpectAllFiguresButSaturation(const Measured& m) {
  EXPECT_NEAR(m.Gain(), 0.0, kGain);
  EXPECT_NEAR(m.Efficiency(), 0.0, kEfficiency);
  EXPECT_NEAR(m.DarkNoise(), 0.0, kDarkNoise);
  EXPECT_NEAR(m.Dsnu(), 0.0, kUniformity);
  EXPECT_NEAR(m.Prnu(), 0.0, kUniformity);
}

void ExpectAllFigures(const Measured& m) {
  ExpectAllFiguresButSaturation(m);
  EXPECT_NEAR(m.Saturation(), 0.0, kSaturation);
}

TEST(EmvaEvaluationTest, ReturnsWhatWasPutInAtTenBits) {
  const Measured m = Measure(Small(), TenBits(), TenBits());
  ExpectAllFigures(m);
  // A linear sensor: what deviates is noise, 1/√(2n) of some electrons.
  EXPECT_LT(std::abs(m.results.linearity_error_max), 1e-3);
  EXPECT_LT(std::abs(m.results.linearity_error_min), 1e-3);
  // Neither rows nor columns have a pattern.
  EXPECT_LT(m.results.dsnu_e.row, 0.15 * m.put_in.dsnu_e);
  EXPECT_LT(m.results.dsnu_e.column, 0.15 * m.put_in.dsnu_e);
  EXPECT_NEAR(m.results.dsnu_e.pixel / m.put_in.dsnu_e, 1.0, kUniformity);
  // SNR and dynamic range follow from the rest.
  EXPECT_NEAR(m.results.largest_snr, std::sqrt(m.results.saturation_e), 1e-9);
  const double threshold_e =
      std::hypot(m.put_in.dark_noise_e, std::sqrt(1.0 / 12.0) / m.put_in.gain_dn_per_e) + 0.5;
  EXPECT_NEAR(m.results.dynamic_range * threshold_e / m.put_in.saturation_e.value(), 1.0, 0.05);
}

TEST(EmvaEvaluationTest, ReturnsWhatWasPutInAtEightBitsAndFourfoldGain) {
  SimulationOptions options = Small();
  options.gain = 4.0;
  ExpectAllFigures(Measure(options, LinearSensor(), LinearSensor()));
}

TEST(EmvaEvaluationTest, AShoulderChangesNoFigureButSaturationAndLinearity) {
  ImageSensorOptions sensor = TenBits();
  sensor.linear_range = 0.65;
  const Measured m = Measure(Small(), sensor, sensor);
  ExpectAllFiguresButSaturation(m);
  // The variance is flat from the shoulder's beginning to where pixels are clipped.
  EXPECT_FALSE(m.put_in.saturation_e);
  EXPECT_GT(m.results.saturation_e, 0.65 * 0.95 * sensor.saturation_e);
  EXPECT_LT(m.results.saturation_e, 1.05 * sensor.saturation_e);
  EXPECT_GT(m.results.linearity_error_max - m.results.linearity_error_min, 1e-3);
}

TEST(EmvaEvaluationTest, DarkCurrentDoublesWithTemperature) {
  ImageSensorOptions sensor = TenBits();
  sensor.dark_current_e_s = 2000.0;
  sensor.temperature_c = 25.0;
  const double cool = Measure(Small(), sensor, sensor).results.dark_current_e_s;
  sensor.temperature_c += sensor.dark_current_doubling_k;
  const double warm = Measure(Small(), sensor, sensor).results.dark_current_e_s;
  // Image means are known to 26 e/√(2n) = 0.08 e, the slope over 20 ms to about 2 e/s.
  EXPECT_NEAR(cool, 2000.0, 20.0);
  EXPECT_NEAR(warm / cool, 2.0, 0.02);
}

TEST(EmvaEvaluationTest, WrongShotNoiseIsFoundOut) {
  // A tenth more variance than Poisson's: noise that was added after the fact.
  const double K = PutInBy(Small(), TenBits()).gain_dn_per_e;
  const auto noisier = [&](cv::Mat1w& image, const ImageSet& set, size_t i) {
    const double signal = K * 0.524 * set.photons;
    cv::Mat1f extra(image.size());
    RandomStream(9)
        .Child("extra", static_cast<uint64_t>(1e9 * set.exposure_s))
        .Child(set.is_dark() ? "dark" : "bright", i)
        .FillNormals({extra.ptr<float>(), extra.total()});
    cv::Mat1f sum;
    image.convertTo(sum, CV_32F);
    sum += extra * std::sqrt(0.1 * K * signal);
    sum.convertTo(image, CV_16U);
  };
  const Measured m = Measure(Small(), TenBits(), TenBits(), noisier);
  EXPECT_GT(m.Gain(), kGain);
  EXPECT_LT(m.Efficiency(), -kEfficiency);
}

TEST(EmvaEvaluationTest, NoShotNoiseAtAllIsRefused) {
  ImageSensorOptions silent = TenBits();
  silent.noise = false;
  EXPECT_THROW(Measure(Small(), TenBits(), silent), InputError);
}

TEST(EmvaEvaluationTest, AWrongGainIsFoundOut) {
  ImageSensorOptions weaker = TenBits();
  weaker.saturation_e /= 0.95;  // 5 % fewer DN per electron.
  const Measured m = Measure(Small(), TenBits(), weaker);
  EXPECT_LT(m.Gain(), -kGain);
}

TEST(EmvaEvaluationTest, AWrongQuantumEfficiencyIsFoundOut) {
  SimulationOptions options = Small();
  const Series series = PlanSeries(options, TenBits());
  const PutIn put_in = PutInBy(options, TenBits());
  options.quantum_efficiency *= 0.95;
  const Results r = Evaluate(series, Simulate(options, TenBits(), RandomStream(5)));
  EXPECT_LT(r.quantum_efficiency / put_in.quantum_efficiency - 1.0, -kEfficiency);
}

TEST(EmvaEvaluationTest, WrongQuantisationIsFoundOut) {
  // The three lowest bits are lost: dark noise of 1.6 DN no longer fills a step of 8 DN.
  const auto coarse = [](cv::Mat1w& image, const ImageSet&, size_t) {
    for (uint16_t& dn : image) dn = static_cast<uint16_t>(dn & ~7);
  };
  const Measured m = Measure(Small(), TenBits(), TenBits(), coarse);
  EXPECT_GT(std::abs(m.DarkNoise()), kDarkNoise);
}

TEST(EmvaEvaluationTest, WrongPatternsAreFoundOut) {
  ImageSensorOptions uneven = TenBits();
  uneven.prnu *= 1.25;
  uneven.dsnu_e *= 1.25;
  const Measured m = Measure(Small(), TenBits(), uneven);
  EXPECT_GT(m.Prnu(), kUniformity);
  EXPECT_GT(m.Dsnu(), kUniformity);
}

TEST(EmvaEvaluationTest, EarlySaturationIsFoundOut) {
  const auto clipped = [](cv::Mat1w& image, const ImageSet&, size_t) {
    for (uint16_t& dn : image) dn = std::min<uint16_t>(dn, 930);
  };
  const Measured m = Measure(Small(), TenBits(), TenBits(), clipped);
  EXPECT_LT(m.Saturation(), -kSaturation);
}

TEST(EmvaEvaluationTest, AtEightBitsAndGainOneTheStandardsFloorHidesTheDarkNoise) {
  // 0.24 DN² is the least that the standard lets dark variance be: 25.6 e at 64.6 e per DN. A
  // sensor of 12 e measures the same as one of 25 e does.
  ImageSensorOptions quiet = LinearSensor();
  quiet.read_noise_e = 12.0;
  const Measured m = Measure(Small(), quiet, quiet);
  EXPECT_GT(m.DarkNoise(), kDarkNoise);
  EXPECT_TRUE(m.results.dark_noise_is_floor);
}

TEST(EmvaEvaluationTest, ASeriesThatLacksSomethingIsRefusedWithTheReason) {
  const SimulationOptions options = Small();
  const ImageReader images = Simulate(options, TenBits(), RandomStream(5));
  const auto message = [&](Series series, const std::function<bool(const ImageSet&)>& drop) {
    std::erase_if(series.sets, drop);
    try {
      Evaluate(series, images);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const Series whole = PlanSeries(options, TenBits());
  EXPECT_THAT(message(whole, [](const ImageSet& s) { return s.is_dark() && !s.is_spatial(); }),
              HasSubstr("no dark pair"));
  EXPECT_THAT(message(whole, [](const ImageSet& s) { return s.is_spatial(); }), HasSubstr("stack"));
  EXPECT_THAT(message(whole, [](const ImageSet& s) { return s.exposure_s > 10e-3; }),
              HasSubstr("does not reach saturation"));
}

}  // namespace
}  // namespace fenestra::emva
