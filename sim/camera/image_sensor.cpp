#include "sim/camera/image_sensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/io/faults.h"
#include "core/system/check.h"
#include "core/system/wide.h"

namespace fenestra {
namespace {

// Temperature for which the dark current is stated.
constexpr double kReferenceTemperature_c = 25.0;

double AdcFullScale(const ImageSensorOptions& o) {
  return static_cast<double>((1 << o.adc_bits) - 1);
}

// Output DN per ADC DN.
double OutputScale(const ImageSensorOptions& o) {
  return std::ldexp(1.0, o.output_bits - o.adc_bits);
}

cv::Mat1f Normals(const RandomStream& stream, cv::Size size) {
  cv::Mat1f normals(size);
  stream.FillNormals({normals.ptr<float>(), normals.total()});
  return normals;
}

// The constants of one image, in single precision.
struct Readout {
  float exposure_s;
  float dark_e;
  float read_variance_e2;
  float dn_per_e;
  float black_dn;
  float shoulder_dn;  // Above black.
  float full_scale_dn;
};

// Mean electrons of a row, with the pixels' sensitivities and dark current.
FENESTRA_WIDE void CollectRow(const float* electrons_per_s, const float* sensitivity,
                              const Readout& readout, float* mean_e, int count) {
  for (int u = 0; u < count; ++u) {
    mean_e[u] = electrons_per_s[u] * sensitivity[u] * readout.exposure_s + readout.dark_e;
  }
}

// Replaces the means by one draw of electrons. z is standard normal.
FENESTRA_WIDE void AddNoiseRow(const float* z, float read_variance_e2, float* mean_e, int count) {
  for (int u = 0; u < count; ++u) {
    const float mean = mean_e[u];
    // At least a thousandth of an electron of noise keeps the division finite.
    const float variance = mean + read_variance_e2 + 1e-6f;
    const float skew = mean / (6.0f * variance);  // κ₃/(6 κ₂) [e]
    const float deviation_squared = variance - 2.0f * skew * skew;
    mean_e[u] = mean + std::sqrt(deviation_squared) * z[u] + skew * (z[u] * z[u] - 1.0f);
  }
}

FENESTRA_WIDE void DigitiseRow(const float* electrons, const float* offset_e, float row_offset_e,
                               const Readout& readout, int shift, uint16_t* dn, int count) {
  for (int u = 0; u < count; ++u) {
    const float linear = readout.dn_per_e * (electrons[u] + offset_e[u] + row_offset_e);
    // Where the response is linear, the root is that of s² and the difference is 0.
    const float beyond = std::sqrt(readout.shoulder_dn * std::max(linear, readout.shoulder_dn));
    const float response =
        std::min(linear, readout.shoulder_dn) + 2.0f * (beyond - readout.shoulder_dn);
    const float value = readout.black_dn + response + 0.5f;
    const float clipped = std::min(std::max(value, 0.0f), readout.full_scale_dn);
    dn[u] = static_cast<uint16_t>(static_cast<int>(clipped) >> shift);
  }
}

}  // namespace

void Validate(const ImageSensorOptions& o, const char* who) {
  Faults faults(who);
  faults.Require(o.saturation_e > 0.0,
                 fmt::format("saturation {} e is not positive", o.saturation_e));
  faults.Require(o.linear_range > 0.0 && o.linear_range <= 1.0,
                 fmt::format("a linear range of {} is not a share of full scale", o.linear_range));
  faults.Require(o.read_noise_e >= 0.0 && o.dark_current_e_s >= 0.0 && o.dsnu_e >= 0.0 &&
                     o.prnu >= 0.0 && o.row_noise_e >= 0.0,
                 "noise figures must not be negative");
  faults.Require(o.dark_current_doubling_k > 0.0,
                 "dark current must double over a positive temperature");
  faults.Require(o.adc_bits >= 1 && o.adc_bits <= 16,
                 fmt::format("an ADC of {} bits is not between 1 and 16", o.adc_bits));
  faults.Require(
      o.output_bits >= 1 && o.output_bits <= o.adc_bits,
      fmt::format("{} output bits are not between 1 and the ADC's {}", o.output_bits, o.adc_bits));
  faults.Require(o.black_level_dn >= 0.0 && o.black_level_dn < AdcFullScale(o),
                 fmt::format("black level {} DN is outside the ADC's range", o.black_level_dn));
  faults.ThrowIfAny();
}

ExposureSetting ChooseExposure(const ExposureOptions& exposure, const ImageSensorOptions& sensor,
                               double mean_electrons_per_s) {
  if (!exposure.automatic) return {.exposure_s = exposure.exposure_s, .gain = exposure.gain};
  const double wanted_s = exposure.set_point * sensor.saturation_e / mean_electrons_per_s;
  // Written so that darkness, a division by zero, gives the longest exposure.
  const double exposure_s = std::max(exposure.shortest_s, std::min(exposure.longest_s, wanted_s));
  const double gain = std::max(1.0, std::min(exposure.largest_gain, wanted_s / exposure.longest_s));
  return {.exposure_s = exposure_s, .gain = gain};
}

ImageSensor::ImageSensor(const ImageSensorOptions& options, cv::Size size,
                         const RandomStream& camera)
    : options_(options), size_(size) {
  Validate(options_, "image sensor");
  if (!options_.fixed_pattern) return;
  dsnu_e_ = Normals(camera.Child("dsnu"), size) * options_.dsnu_e;
  sensitivity_ = Normals(camera.Child("prnu"), size) * options_.prnu + 1.0;
}

double ImageSensor::DnPerElectron(double gain) const {
  const double dn_per_e =
      (AdcFullScale(options_) - options_.black_level_dn) / options_.saturation_e;
  return gain * dn_per_e * OutputScale(options_);
}

double ImageSensor::FullScaleElectrons(double gain) const {
  // R(x) = 1 in units of the range.
  const double s = options_.linear_range;
  return (1.0 + s) * (1.0 + s) / (4.0 * s) * options_.saturation_e / gain;
}

double ImageSensor::BlackLevelDn() const {
  // Shifting right rounds downwards: half an output step less half an ADC step, on average.
  const double scale = OutputScale(options_);
  return options_.black_level_dn * scale - 0.5 * (1.0 - scale);
}

double ImageSensor::DarkElectrons(double exposure_s) const {
  const double doublings =
      (options_.temperature_c - kReferenceTemperature_c) / options_.dark_current_doubling_k;
  return options_.dark_current_e_s * std::exp2(doublings) * exposure_s;
}

cv::Mat1w ImageSensor::Expose(const cv::Mat1f& electrons_per_s, const ExposureSetting& exposure,
                              const RandomStream& noise) const {
  FENESTRA_CHECK(electrons_per_s.size() == size_, "the image must have the sensor's size");
  const Readout constants{
      .exposure_s = static_cast<float>(exposure.exposure_s),
      .dark_e = static_cast<float>(DarkElectrons(exposure.exposure_s)),
      .read_variance_e2 = static_cast<float>(options_.read_noise_e * options_.read_noise_e),
      .dn_per_e = static_cast<float>(DnPerElectron(exposure.gain) / OutputScale(options_)),
      .black_dn = static_cast<float>(options_.black_level_dn),
      .shoulder_dn = static_cast<float>(options_.linear_range *
                                        (AdcFullScale(options_) - options_.black_level_dn)),
      .full_scale_dn = static_cast<float>(AdcFullScale(options_))};
  const auto width = static_cast<size_t>(size_.width);
  const std::vector<float> ones(width, 1.0f);
  const std::vector<float> zeros(width, 0.0f);
  std::vector<float> row_offsets_e(static_cast<size_t>(size_.height), 0.0f);
  cv::Mat1f z;
  if (options_.noise) {
    z = Normals(noise, size_);
    noise.Child("rows").FillNormals(row_offsets_e);
    for (float& offset : row_offsets_e) offset *= static_cast<float>(options_.row_noise_e);
  }
  const int shift = options_.adc_bits - options_.output_bits;
  std::vector<float> electrons(width);
  cv::Mat1w dn(size_);
  for (int v = 0; v < size_.height; ++v) {
    const float* sensitivity = sensitivity_.empty() ? ones.data() : sensitivity_[v];
    const float* offset_e = dsnu_e_.empty() ? zeros.data() : dsnu_e_[v];
    CollectRow(electrons_per_s[v], sensitivity, constants, electrons.data(), size_.width);
    if (!z.empty()) AddNoiseRow(z[v], constants.read_variance_e2, electrons.data(), size_.width);
    DigitiseRow(electrons.data(), offset_e, row_offsets_e[static_cast<size_t>(v)], constants, shift,
                dn[v], size_.width);
  }
  return dn;
}

}  // namespace fenestra
