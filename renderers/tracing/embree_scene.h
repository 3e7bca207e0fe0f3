#pragma once

#include <span>
#include <string>

#include "renderers/tracing/packet.h"
#include "renderers/tracing/render_types.h"
#include "renderers/tracing/surface_patterns.h"
#include "renderers/tracing/triangle_soup.h"

namespace fenestra {

/// An Embree device. One per RayCaster: devices share nothing, so casters are independent.
class EmbreeDevice {
 public:
  /// Throws std::runtime_error if Embree does not support this machine.
  explicit EmbreeDevice(InstructionSet instruction_set);
  ~EmbreeDevice();
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  RTCDevice get() const { return device_; }

 private:
  RTCDevice device_;
};

/// Whether the rays of a packet are similar: a hint that only affects speed.
enum class Coherence { kCoherent, kIncoherent };

/// The kind of surface that was hit: a hit's geomID.
enum GeometryId : unsigned { kOpaqueGeometry = 0, kHoledGeometry = 1, kPaneGeometry = 2 };

/// The ray tracing structure of triangles. A hit's primID is the triangle's index in its soup. Rays
/// pass holes. Watertight: a ray never slips through the edge that two triangles share.
class EmbreeScene {
 public:
  /// Triangles [first, first + count) of a soup.
  struct Part {
    const TriangleSoup& soup;
    GeometryId id;
    size_t first;
    size_t count;
  };

  /// `patterns` belongs to the soup of the part with holes, and must outlive the scene.
  EmbreeScene(const EmbreeDevice& device, std::span<const Part> parts,
              const SurfacePatterns& patterns);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  bool empty() const { return empty_; }

  /// Fills in the nearest hit of each lane of the mask, if there is one before its tfar.
  void Intersect(const LaneMask& mask, RayPacket& packet, Coherence coherence) const {
    RTCIntersectContext context = Context(coherence);
    rtcIntersect16(mask.data(), scene_, &context, &packet);
    if (holed_first_ == 0) return;
    for (int i = 0; i < kLanes; ++i) {
      if (mask[i] != 0 && packet.hit.geomID[i] == kHoledGeometry) {
        packet.hit.primID[i] += holed_first_;
      }
    }
  }

  /// Sets tfar to minus infinity in each lane of the mask that hits anything before its tfar.
  void Occlude(const LaneMask& mask, RTCRay16& rays, Coherence coherence) const {
    RTCIntersectContext context = Context(coherence);
    rtcOccluded16(mask.data(), scene_, &context, &rays);
  }

 private:
  // Data that Embree passes to the filter of a geometry with holes.
  struct HoleTest {
    const SurfacePatterns* patterns;
    uint32_t first;
  };

  static RTCIntersectContext Context(Coherence coherence) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherence == Coherence::kCoherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                      : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
  }
  static void PassHoles(const RTCFilterFunctionNArguments* arguments);
  void Attach(const EmbreeDevice& device, const Part& part);

  RTCScene scene_;
  bool empty_ = true;
  uint32_t holed_first_ = 0;
  HoleTest hole_test_;
};

/// Version of the Embree library that is loaded, such as "3.13.5".
std::string EmbreeVersion();

}  // namespace fenestra
