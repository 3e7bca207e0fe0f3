#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scenes/gltf/tinygltf.h"
#include "scenes/scene.h"

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

/// Appends the scene's textures and materials, with the same indices. Properties that glTF does not
/// have go into extras.
void WriteTextures(const Scene& scene, tinygltf::Model& model, BufferBuilder& buffer);
void WriteMaterials(const Scene& scene, tinygltf::Model& model);

/// Adds an extension to those that the model says it uses.
void Declare(const std::string& extension, tinygltf::Model& model);

/// Light as fractions of a scale: value = fraction · scale without rounding, with fractions in
/// [0, 1] and a power of two as the scale (1 if all values are in [0, 1] already).
struct ScaledLight {
  std::vector<double> fraction;
  double scale = 1.0;
};
ScaledLight SplitScale(const glm::vec3& light);

}  // namespace fenestra::gltf
