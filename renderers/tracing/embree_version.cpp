#include "renderers/tracing/embree_version.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

namespace fenestra {

std::string EmbreeVersion() {
  const RTCDevice device = rtcNewDevice("threads=1");
  const auto version = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION);
  rtcReleaseDevice(device);
  return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace fenestra
