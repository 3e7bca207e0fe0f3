#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// Appends data to the one buffer of a model that is being written, a view for each. All functions
/// return the index of what they made.
class BufferBuilder {
 public:
  explicit BufferBuilder(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

  /// An accessor of vertex data, with the bounds that positions need.
  int AddVertices(const std::vector<glm::vec3>& values);
  int AddVertices(const std::vector<glm::vec2>& values);
  /// An accessor of triangle indices.
  int AddTriangles(const std::vector<glm::uvec3>& triangles);
  /// A view without accessor, for an image.
  int AddBytes(std::span<const uint8_t> bytes);

 private:
  int AddView(std::span<const uint8_t> bytes, int target);

  tinygltf::Model& model_;
};

}  // namespace fenestra::gltf
