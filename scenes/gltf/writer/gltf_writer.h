#pragma once

#include <filesystem>

#include "core/io/output_path.h"
#include "scenes/gltf/gltf.h"

namespace fenestra {

/// Writes one self-contained file, JSON with embedded data for ".gltf" or binary for ".glb", that
/// appears by rename. Reading it gives the same meshes, materials, textures, windows, lamps and
/// cameras, bit for bit; the sun's angles to rounding. Meshes without triangles are left out, and
/// notes are not written. Throws InputError for another extension or where it cannot be written.
void WriteGltf(const OutputPath& file, const GltfScene& scene);

}  // namespace fenestra
