#include "renderers/embree_scene.h"

#include <cstring>
#include <stdexcept>

#include "core/check.h"

namespace fenestra {

EmbreeDevice::EmbreeDevice() : device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr) throw std::runtime_error("Embree does not run on this machine");
}

EmbreeDevice::~EmbreeDevice() {
  rtcReleaseDevice(device_);
}

EmbreeScene::EmbreeScene(const EmbreeDevice& device, const TriangleSoup& soup)
    : scene_(rtcNewScene(device.get())), empty_(soup.triangles.empty()) {
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  if (!empty_) {
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    static_assert(sizeof(glm::uvec3) == 3 * sizeof(unsigned));
    void* positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), soup.positions_W.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(glm::uvec3), soup.triangles.size());
    FENESTRA_CHECK(positions != nullptr && triangles != nullptr, "Embree is out of memory");
    std::memcpy(positions, soup.positions_W.data(), soup.positions_W.size() * sizeof(glm::vec3));
    std::memcpy(triangles, soup.triangles.data(), soup.triangles.size() * sizeof(glm::uvec3));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_);
  const RTCError error = rtcGetDeviceError(device.get());
  FENESTRA_CHECK(error == RTC_ERROR_NONE, "Embree error " + std::to_string(error));
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
}

}  // namespace fenestra
