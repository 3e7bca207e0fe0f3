#pragma once

#include <filesystem>

#include "scenes/gltf/gltf.h"

namespace fenestra {

/// Reads .gltf or .glb (told apart by their content). Throws InputError, which names the file and
/// the place in it as a JSON pointer, for a file that breaks the rules of glTF 2.0, that requires
/// an extension which is not supported, or that exceeds the limits.
GltfScene ReadGltf(const std::filesystem::path& file, const GltfReadOptions& options = {});

}  // namespace fenestra
