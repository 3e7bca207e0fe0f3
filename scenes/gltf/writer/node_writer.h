#pragma once

#include "scenes/gltf/gltf.h"
#include "scenes/gltf/writer/material_writer.h"

namespace fenestra::gltf {

/// Each appends root nodes to the model's one scene; the order of the meshes is kept. Meshes
/// without triangles are left out, as are texture coordinates that no texture uses.
void WriteMeshes(const Scene& scene, tinygltf::Model& model, BufferBuilder& buffer);
void WriteWindows(const Scene& scene, tinygltf::Model& model);
void WriteCameras(const std::vector<SceneCamera>& cameras, tinygltf::Model& model);
void WriteLights(const GltfScene& scene, tinygltf::Model& model);

}  // namespace fenestra::gltf
