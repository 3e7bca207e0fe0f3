#include "renderers/tracing/embree_scene.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "core/system/check.h"

namespace fenestra {
namespace {

const char* ConfigurationOf(InstructionSet instruction_set) {
  switch (instruction_set) {
    case InstructionSet::kAvx2:
      return "isa=avx2";
    case InstructionSet::kSse42:
      return "isa=sse4.2";
    case InstructionSet::kBest:
      break;
  }
  return nullptr;
}

}  // namespace

EmbreeDevice::EmbreeDevice(InstructionSet instruction_set)
    : device_(rtcNewDevice(ConfigurationOf(instruction_set))) {
  if (device_ == nullptr) throw std::runtime_error("Embree does not run on this machine");
}

EmbreeDevice::~EmbreeDevice() {
  rtcReleaseDevice(device_);
}

EmbreeScene::EmbreeScene(const EmbreeDevice& device, std::span<const Part> parts,
                         const SurfacePatterns& patterns)
    : scene_(rtcNewScene(device.get())), hole_test_{&patterns, 0} {
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  for (const Part& part : parts) {
    if (part.count > 0) Attach(device, part);
  }
  rtcCommitScene(scene_);
  const RTCError error = rtcGetDeviceError(device.get());
  FENESTRA_CHECK(error == RTC_ERROR_NONE, "Embree error " + std::to_string(error));
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
}

void EmbreeScene::Attach(const EmbreeDevice& device, const Part& part) {
  empty_ = false;
  const TriangleSoup& soup = part.soup;
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  static_assert(sizeof(glm::uvec3) == 3 * sizeof(unsigned));
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            sizeof(glm::vec3), soup.positions_W.size());
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(glm::uvec3), part.count);
  FENESTRA_CHECK(positions != nullptr && triangles != nullptr, "Embree is out of memory");
  std::memcpy(positions, soup.positions_W.data(), soup.positions_W.size() * sizeof(glm::vec3));
  std::memcpy(triangles, &soup.triangles[part.first], part.count * sizeof(glm::uvec3));
  if (part.id == kHoledGeometry) {
    holed_first_ = static_cast<uint32_t>(part.first);
    hole_test_.first = holed_first_;
    rtcSetGeometryUserData(geometry, &hole_test_);
    rtcSetGeometryIntersectFilterFunction(geometry, PassHoles);
    rtcSetGeometryOccludedFilterFunction(geometry, PassHoles);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, part.id);
  rtcReleaseGeometry(geometry);
}

void EmbreeScene::PassHoles(const RTCFilterFunctionNArguments* arguments) {
  const auto& test = *static_cast<const HoleTest*>(arguments->geometryUserPtr);
  const unsigned n = arguments->N;
  for (unsigned i = 0; i < n; ++i) {
    if (arguments->valid[i] == 0) continue;
    const uint32_t triangle = test.first + RTCHitN_primID(arguments->hit, n, i);
    if (test.patterns->IsHole(triangle, RTCHitN_u(arguments->hit, n, i),
                              RTCHitN_v(arguments->hit, n, i))) {
      arguments->valid[i] = 0;
    }
  }
}

std::string EmbreeVersion() {
  const RTCDevice device = rtcNewDevice("threads=1");
  const auto version = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION);
  rtcReleaseDevice(device);
  return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace fenestra
