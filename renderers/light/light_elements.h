#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "renderers/light/light_patches.h"

namespace fenestra {

/// A point of a LightBake and how much it counts.
struct PointWeight {
  uint32_t point = 0;
  float w = 0.0f;
};

/// The elements of all faces between which light is exchanged: cells of a patch's rectangle, or
/// whole triangles with normals of their own. An element sends out the same light from everywhere.
/// Elements are made as they are seen, and the smaller the nearer the viewer: no longer than the
/// distance, from 5 to 64 cm. So they overlap, and what is next to a point is known as finely as
/// the point needs it.
class LightElements {
 public:
  static constexpr uint32_t kNone = ~0u;

  /// A place on a triangle of an element's face.
  struct Sample {
    uint32_t triangle = 0;
    glm::vec2 st{0.0f};
  };

  /// The element that is seen of a face at a place from a distance; kNone for the inside of a body.
  uint32_t See(const LightPatches& patches, uint32_t face, const Sample& at, float distance_m);

  size_t size() const { return elements_.size(); }
  uint32_t FaceOf(size_t element) const { return elements_[element].face; }
  /// Up to eight of the places at which the element was seen; its quantities are their means.
  std::span<const Sample> SamplesOf(size_t element) const { return elements_[element].samples; }

 private:
  struct Element {
    uint32_t face = 0;
    uint32_t times_seen = 0;
    std::vector<Sample> samples;
  };

  std::vector<Element> elements_;
  std::unordered_map<uint64_t, uint32_t> index_;
};

}  // namespace fenestra
