#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "scenes/gltf/file/bytes.h"
#include "scenes/gltf/gltf.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// A glTF file whose structure holds: every index exists, every accessor lies within its data, the
/// nodes are a forest. The numbers in the buffers are still unchecked.
struct Asset {
  std::filesystem::path file;
  /// Without `buffers` and `images`, whose bytes are below: tinygltf never sees data from outside.
  tinygltf::Model model;
  /// In the document's order; none where glTF leaves the content undefined (a buffer without URI).
  std::vector<std::optional<Bytes>> buffers;
  std::vector<Bytes> images;  ///< Encoded, as PNG, JPEG or whatever an extension allows.
  std::vector<std::string> ignored_extensions;
};

/// Reads a file and all it refers to. Throws InputError.
Asset LoadAsset(const std::filesystem::path& file, const GltfReadOptions& options);

}  // namespace fenestra::gltf
