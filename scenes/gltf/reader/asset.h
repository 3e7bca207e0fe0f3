#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/gltf/file/bytes.h"
#include "scenes/gltf/gltf.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// Collects what a reader leaves out or approximates: one sentence for each kind, with the names of
/// the things concerned.
class Notes {
 public:
  /// `what` is the rest of a sentence that begins with the thing's name.
  void Add(std::string_view what, std::string thing);

  /// "material 'a', material 'b' and 7 more: <what>", in the order of what was added first.
  std::vector<std::string> Sentences() const;

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> things_by_what_;
};

/// "material 'paint'", or "material 3" where it has no name.
std::string Named(std::string_view kind, std::string_view name, size_t index);

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
