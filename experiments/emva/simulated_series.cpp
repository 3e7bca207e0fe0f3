#include "experiments/emva/simulated_series.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "core/io/faults.h"
#include "core/io/image_io.h"
#include "core/io/temporary_files.h"

namespace fenestra::emva {
namespace {

// The longest exposure collects this multiple of saturation.
constexpr double kBeyondSaturation = 1.08;

double PhotonsPerSecond(const SimulationOptions& o, const ImageSensorOptions& sensor) {
  const ImageSensor instance(sensor, {1, 1}, RandomStream(0));
  return kBeyondSaturation * instance.FullScaleElectrons(o.gain) / o.quantum_efficiency /
         o.longest_exposure_s;
}

double Density(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}
double Distribution(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

// Variance of a normal variate that is clipped from above.
double ClippedVariance(double mean, double deviation, double limit) {
  const double z = (limit - mean) / deviation;
  const double below = Distribution(z);
  const double first = mean * below + limit * (1.0 - below) - deviation * Density(z);
  const double second = (mean * mean + deviation * deviation) * below -
                        (mean + limit) * deviation * Density(z) + limit * limit * (1.0 - below);
  return second - first * first;
}

// Temporal variance averaged over the pixels [e²], by a sum over their sensitivities.
double MeanVariance(double electrons, const ImageSensorOptions& sensor, double limit) {
  constexpr int kSteps = 80;
  constexpr double kReach = 4.0;
  const double prnu = sensor.fixed_pattern ? sensor.prnu : 0.0;
  double sum = 0.0;
  double weights = 0.0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const double z = kReach * i / kSteps;
    const double mean = electrons * (1.0 + prnu * z);
    const double deviation = std::sqrt(std::max(
        mean + sensor.read_noise_e * sensor.read_noise_e + sensor.row_noise_e * sensor.row_noise_e,
        1e-6));
    sum += Density(z) * ClippedVariance(mean, deviation, limit);
    weights += Density(z);
  }
  return sum / weights;
}

std::optional<double> SaturationCapacity(const ImageSensorOptions& sensor, double gain) {
  if (sensor.linear_range < 1.0) return std::nullopt;
  const double full_e = sensor.saturation_e / gain;
  double best_e = 0.0;
  double largest = 0.0;
  for (double electrons = 0.7 * full_e; electrons < full_e; electrons += 0.001 * full_e) {
    const double variance = MeanVariance(electrons, sensor, full_e);
    if (variance > largest) {
      largest = variance;
      best_e = electrons;
    }
  }
  return best_e;
}

std::vector<std::string> ImageNames(const std::string& set, int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back(fmt::format("images/{}_{:03}.png", set, i));
  return names;
}

}  // namespace

void Validate(const SimulationOptions& o) {
  Faults faults("EMVA series");
  faults.Require(
      o.size.width >= 8 && o.size.width <= 16384 && o.size.height >= 8 && o.size.height <= 16384,
      fmt::format("frames of {} x {} px are not between 8 and 16384", o.size.width, o.size.height));
  faults.Require(o.exposures >= 10 && o.exposures <= 10000,
                 fmt::format("{} exposures are not between 10 and 10000", o.exposures));
  faults.Require(o.frames >= 3 && o.frames <= 10000,
                 fmt::format("stacks of {} frames are not between 3 and 10000", o.frames));
  faults.Require(o.gain > 0.0, "the gain must be positive");
  faults.Require(o.quantum_efficiency > 0.0 && o.quantum_efficiency <= 1.0,
                 fmt::format("the sensor sees nothing at {:g} nm", o.wavelength_nm));
  faults.Require(o.longest_exposure_s > 0.0, "the longest exposure must be positive");
  faults.ThrowIfAny();
}

Series PlanSeries(const SimulationOptions& options, const ImageSensorOptions& sensor) {
  Validate(options);
  fenestra::Validate(sensor, "image sensor");
  Series series{.bits = sensor.output_bits, .size = options.size, .sets = {}};
  const double photons_per_s = PhotonsPerSecond(options, sensor);
  // Whole microseconds, so that a descriptor in nanoseconds tells exposures exactly.
  const auto exposure = [&](double share) {
    return 1e-6 * std::max(1.0, std::round(1e6 * share * options.longest_exposure_s));
  };
  const auto add = [&](double exposure_s, bool bright, const std::string& name, int count) {
    series.sets.push_back({.exposure_s = exposure_s,
                           .photons = bright ? exposure_s * photons_per_s : 0.0,
                           .files = ImageNames(name, count)});
  };
  for (int i = 1; i <= options.exposures; ++i) {
    const double exposure_s = exposure(static_cast<double>(i) / options.exposures);
    add(exposure_s, true, fmt::format("bright_{:04}", i), 2);
    add(exposure_s, false, fmt::format("dark_{:04}", i), 2);
  }
  const double half_s = exposure(0.5 / kBeyondSaturation);
  add(half_s, true, "stack_bright", options.frames);
  add(half_s, false, "stack_dark", options.frames);
  return series;
}

ImageReader Simulate(const SimulationOptions& options, const ImageSensorOptions& sensor,
                     const RandomStream& camera) {
  const ImageSensor instance(sensor, options.size, camera.Child("pattern"));
  return [instance, options, camera](const ImageSet& set, size_t index) {
    const double electrons_per_s = options.quantum_efficiency * set.photons / set.exposure_s;
    const cv::Mat1f light(options.size, static_cast<float>(electrons_per_s));
    const RandomStream noise = camera.Child(set.is_spatial() ? "stack" : "pair")
                                   .Child("exposure", std::bit_cast<uint64_t>(set.exposure_s))
                                   .Child(set.is_dark() ? "dark" : "bright", index);
    return instance.Expose(light, {.exposure_s = set.exposure_s, .gain = options.gain}, noise);
  };
}

PutIn PutInBy(const SimulationOptions& options, const ImageSensorOptions& sensor) {
  const ImageSensor instance(sensor, {8, 8}, RandomStream(0));
  return {.gain_dn_per_e = instance.DnPerElectron(options.gain),
          .quantum_efficiency = options.quantum_efficiency,
          // An image's rows differ by their own noise, too.
          .dark_noise_e = sensor.noise ? std::hypot(sensor.read_noise_e, sensor.row_noise_e) : 0.0,
          .dark_current_e_s = instance.DarkElectrons(1.0),
          .saturation_e = SaturationCapacity(sensor, options.gain),
          .dsnu_e = sensor.fixed_pattern ? sensor.dsnu_e : 0.0,
          .prnu = sensor.fixed_pattern ? sensor.prnu : 0.0};
}

std::filesystem::path WriteSeries(const OutputPath& folder, const Series& series,
                                  const ImageReader& images) {
  for (const ImageSet& set : series.sets) {
    for (size_t i = 0; i < set.files.size(); ++i) {
      const cv::Mat1w dn = images(set, i);
      cv::Mat image = dn;
      if (series.bits <= 8) dn.convertTo(image, CV_8U);
      WritePng(folder / set.files[i], image);
    }
  }
  const OutputPath descriptor = folder / "emva1288.txt";
  WriteFileAtomically(descriptor, ToDescriptor(series));
  return descriptor.path();
}

}  // namespace fenestra::emva
