#include "sim/camera/spectral_response.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fenestra {
namespace {

constexpr double kFirst_nm = 380.0;
constexpr double kStep_nm = 10.0;
constexpr size_t kSamples = 63;
using Samples = std::array<double, kSamples>;

double WavelengthOf(size_t sample) {
  return kFirst_nm + kStep_nm * static_cast<double>(sample);
}

// onsemi MT9V034/D Rev. 7, Fig. 47 (380 nm: extrapolated).
constexpr Samples kQuantumEfficiency = {
    0.299, 0.335, 0.371, 0.406, 0.436, 0.458, 0.479, 0.498, 0.515, 0.524, 0.532, 0.533, 0.531,
    0.525, 0.520, 0.524, 0.521, 0.524, 0.541, 0.551, 0.561, 0.575, 0.579, 0.575, 0.579, 0.579,
    0.564, 0.549, 0.549, 0.553, 0.546, 0.536, 0.530, 0.533, 0.533, 0.520, 0.505, 0.500, 0.492,
    0.483, 0.473, 0.456, 0.434, 0.416, 0.403, 0.387, 0.366, 0.347, 0.329, 0.308, 0.283, 0.259,
    0.238, 0.219, 0.200, 0.180, 0.161, 0.144, 0.128, 0.111, 0.094, 0.079, 0.068};

// ASTM G173-03, global, means over 10 nm [W/(m² nm)].
constexpr Samples kDaylight = {
    0.6623, 0.6735, 0.9948, 1.1646, 1.2222, 1.1266, 1.3475, 1.4994, 1.5644, 1.5542, 1.5980,
    1.5109, 1.5433, 1.5588, 1.4892, 1.5317, 1.5340, 1.5416, 1.5126, 1.4927, 1.5041, 1.4465,
    1.4662, 1.4707, 1.4429, 1.4093, 1.4465, 1.4012, 1.3542, 1.4144, 1.3941, 1.2075, 1.2914,
    1.3063, 1.0992, 1.1165, 1.2201, 1.2379, 0.7857, 1.0823, 1.1674, 1.1163, 1.0828, 1.0343,
    0.8763, 0.9309, 1.0006, 0.9607, 0.9836, 0.9404, 0.9376, 0.9037, 0.7053, 0.6755, 0.7024,
    0.4647, 0.3047, 0.3356, 0.4143, 0.6108, 0.6519, 0.7422, 0.7348};

// CIE 1924 luminous efficiency; 0 beyond 770 nm.
constexpr Samples kLuminousEfficiency = {
    3.9e-05, 0.00012, 0.000396, 0.00121,  0.004,    0.0116,  0.023,    0.038,   0.06,  0.09098,
    0.13902, 0.20802, 0.323,    0.503,    0.71,     0.862,   0.954,    0.99495, 0.995, 0.952,
    0.87,    0.757,   0.631,    0.503,    0.381,    0.265,   0.175,    0.107,   0.061, 0.032,
    0.017,   0.00821, 0.004102, 0.002091, 0.001047, 0.00052, 0.000249, 0.00012, 6e-05, 3e-05};

// A black body's radiation at 2856 K, up to a factor (Planck).
double Incandescent(double wavelength_nm) {
  constexpr double kSecondConstant = 1.4388e7;  // h c / k [nm K]
  constexpr double kTemperature = 2856.0;
  const double micrometres = 1e-3 * wavelength_nm;
  return std::pow(micrometres, -5.0) /
         (std::exp(kSecondConstant / (wavelength_nm * kTemperature)) - 1.0);
}

double IrradianceOf(Illuminant illuminant, size_t sample) {
  return illuminant == Illuminant::kDaylight ? kDaylight[sample]
                                             : Incandescent(WavelengthOf(sample));
}

// Share of the 10 nm around a sample that the filter lets pass.
double PassingShare(double cut_off_nm, size_t sample) {
  const double share = (cut_off_nm - WavelengthOf(sample)) / kStep_nm + 0.5;
  return std::fmin(1.0, std::fmax(0.0, share));
}

}  // namespace

double QuantumEfficiency(double wavelength_nm) {
  const double place = (wavelength_nm - kFirst_nm) / kStep_nm;
  if (!(place >= 0.0 && place <= kSamples - 1)) return 0.0;
  const size_t sample = std::min(static_cast<size_t>(place), kSamples - 2);
  const double t = place - static_cast<double>(sample);
  return (1.0 - t) * kQuantumEfficiency[sample] + t * kQuantumEfficiency[sample + 1];
}

double ElectronsPerLuxSecond(const SpectralOptions& options, double pixel_pitch_m) {
  constexpr double kPlanckTimesLight = 6.62607015e-34 * 299792458.0;  // [J m]
  constexpr double kLumenPerWatt = 683.0;
  double electrons = 0.0;  // Per second and square metre of pixel.
  double lux = 0.0;
  for (size_t i = 0; i < kSamples; ++i) {
    const double irradiance = IrradianceOf(options.illuminant, i) * kStep_nm;
    electrons += irradiance * kQuantumEfficiency[i] * PassingShare(options.cut_off_nm, i) *
                 (1e-9 * WavelengthOf(i)) / kPlanckTimesLight;
    lux += kLumenPerWatt * irradiance * kLuminousEfficiency[i];
  }
  return options.quantum_efficiency_scale * electrons * pixel_pitch_m * pixel_pitch_m / lux;
}

}  // namespace fenestra
