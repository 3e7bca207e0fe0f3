#pragma once

#include "scenes/gltf/writer/buffer_builder.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

/// Appends the scene's textures and materials, with the same indices. What glTF has no word for
/// goes into extras.
void WriteTextures(const Scene& scene, tinygltf::Model& model, BufferBuilder& buffer);
void WriteMaterials(const Scene& scene, tinygltf::Model& model);

/// Adds an extension to those that the model says it uses.
void Declare(const std::string& extension, tinygltf::Model& model);

/// A number of light and its unit: value = fraction · scale without rounding, each fraction in
/// [0, 1], as the scale is a power of two (or 1, where all values fit already).
struct ScaledLight {
  std::vector<double> fraction;
  double scale = 1.0;
};
ScaledLight SplitScale(const glm::vec3& light);

}  // namespace fenestra::gltf
