#pragma once

#include "scenes/gltf/writer/buffer_builder.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

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
