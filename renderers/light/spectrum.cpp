#include "renderers/light/spectrum.h"

namespace fenestra {

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
