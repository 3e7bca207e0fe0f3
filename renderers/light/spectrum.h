#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "renderers/tracing/render_types.h"
#include "scenes/lighting.h"
#include "scenes/scene.h"

namespace fenestra {

/// A quantity in red, green and blue (photometric: white under E lux has E in each) and at 830 nm
/// (radiometric, per nm).
using Spectrum = glm::vec4;

/// Luminance of linear red, green and blue; Rec. ITU-R BT.709.
inline constexpr glm::vec3 kRec709{0.2126f, 0.7152f, 0.0722f};

inline float Luminance(const glm::vec3& rgb) {
  return kRec709.r * rgb.r + kRec709.g * rgb.g + kRec709.b * rgb.b;
}

/// A pattern's factors, at 830 nm by their luminance: see Material::texture.
inline Spectrum PatternSpectrum(const glm::vec3& factors) {
  return {factors, Luminance(factors)};
}

inline Spectrum ReflectanceSpectrum(const Material& material) {
  return {material.reflectance_rgb, material.reflectance_830nm};
}

inline Spectrum EmissionSpectrum(const Material& material) {
  return {material.emission_rgb, material.emission_830nm};
}

/// Intensity [cd] and spectral intensity at 830 nm [W/(sr nm)].
inline Spectrum IntensitySpectrum(const Lamp& lamp) {
  return {lamp.intensity_rgb,
          Luminance(lamp.intensity_rgb) * static_cast<float>(lamp.irradiance_830_per_lux)};
}

/// Illuminance by a sky or a sun with the lighting's spectral irradiance at 830 nm per lux.
Spectrum DaylightSpectrum(double illuminance_lx, const Lighting& lighting);

/// Exitance of the unobstructed ground: ρ_g (E_sky + E_sun sin γ_sun).
Spectrum GroundExitance(const Lighting& lighting);

/// The sun's illuminance; 0 below the horizon.
double SunIlluminance(const Lighting& lighting);

/// One quantity in which light is measured.
enum class Channel { kLuminance, kRed, kGreen, kBlue, kInfrared, kIlluminance, kIrradiance830 };

/// The channels of a band, in the order of its image.
std::vector<Channel> ChannelsOf(Band band);

/// A channel is this weighted sum over a spectrum.
Spectrum WeightsOf(Channel channel);

/// Whether a channel measures light that arrives on surfaces rather than light that leaves them.
inline bool IsArriving(Channel channel) {
  return channel == Channel::kIlluminance || channel == Channel::kIrradiance830;
}

}  // namespace fenestra
