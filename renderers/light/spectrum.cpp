#include "renderers/light/spectrum.h"

namespace fenestra {

Spectrum DaylightSpectrum(double illuminance_lx, const Lighting& lighting) {
  const auto E = static_cast<float>(illuminance_lx);
  return {E, E, E, static_cast<float>(illuminance_lx * lighting.irradiance_830_per_lux)};
}

double SunIlluminance(const Lighting& lighting) {
  return lighting.sun.Direction_W().y() > 0.0 ? lighting.sun.illuminance_lx : 0.0;
}

Spectrum GroundExitance(const Lighting& lighting) {
  const double E =
      lighting.sky.illuminance_lx + SunIlluminance(lighting) * lighting.sun.Direction_W().y();
  return DaylightSpectrum(lighting.sky.ground_reflectance * E, lighting);
}

std::vector<Channel> ChannelsOf(Band band) {
  switch (band) {
    case Band::kRgb:
      return {Channel::kBlue, Channel::kGreen, Channel::kRed};
    case Band::kInfrared:
      return {Channel::kInfrared};
    case Band::kLuminance:
      break;
  }
  return {Channel::kLuminance};
}

Spectrum WeightsOf(Channel channel) {
  switch (channel) {
    case Channel::kRed:
      return {1.0f, 0.0f, 0.0f, 0.0f};
    case Channel::kGreen:
      return {0.0f, 1.0f, 0.0f, 0.0f};
    case Channel::kBlue:
      return {0.0f, 0.0f, 1.0f, 0.0f};
    case Channel::kInfrared:
    case Channel::kIrradiance830:
      return {0.0f, 0.0f, 0.0f, 1.0f};
    case Channel::kLuminance:
    case Channel::kIlluminance:
      break;
  }
  return {kRec709, 0.0f};
}

}  // namespace fenestra
