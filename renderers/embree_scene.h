#pragma once

#include "renderers/packet.h"
#include "renderers/triangle_soup.h"

namespace fenestra {

/// An Embree device. One per RayCaster: devices share nothing, so casters are independent.
class EmbreeDevice {
 public:
  /// Throws std::runtime_error if Embree does not support this machine.
  EmbreeDevice();
  ~EmbreeDevice();
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  RTCDevice get() const { return device_; }

 private:
  RTCDevice device_;
};

/// How alike the rays of a packet are: only a hint for speed.
enum class Coherence { kCoherent, kIncoherent };

/// The ray tracing structure of a triangle soup. A hit's primID is the triangle's index in the
/// soup. Watertight: a ray never slips through the edge that two triangles share.
class EmbreeScene {
 public:
  EmbreeScene(const EmbreeDevice& device, const TriangleSoup& soup);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  bool empty() const { return empty_; }

  /// Fills in the nearest hit of each lane of the mask, if there is one before its tfar.
  void Intersect(const LaneMask& mask, RayPacket& packet, Coherence coherence) const {
    RTCIntersectContext context = Context(coherence);
    rtcIntersect16(mask.data(), scene_, &context, &packet);
  }

  /// Sets tfar to minus infinity in each lane of the mask that hits anything before its tfar.
  void Occlude(const LaneMask& mask, RTCRay16& rays, Coherence coherence) const {
    RTCIntersectContext context = Context(coherence);
    rtcOccluded16(mask.data(), scene_, &context, &rays);
  }

 private:
  static RTCIntersectContext Context(Coherence coherence) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherence == Coherence::kCoherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                      : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
  }

  RTCScene scene_;
  bool empty_;
};

}  // namespace fenestra
