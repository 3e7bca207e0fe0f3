#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"
#include "scenes/lighting.h"
#include "scenes/scene.h"

namespace fenestra {

/// A camera that stands in a scene. Frame C as everywhere: +x right, +y down, +z forward; glTF's
/// own camera axes (+y up, looking along -z) are converted on reading and writing.
struct SceneCamera {
  std::string name;
  Pose X_WC;
  CameraModel model;
};

/// What a glTF file holds, in Fenestra's terms. docs/gltf.md says how the one maps to the other.
struct GltfScene {
  Scene scene;
  std::vector<SceneCamera> cameras;
  std::optional<Sun> sun;
  /// What the file has and Fenestra leaves out or approximates; one sentence each.
  std::vector<std::string> notes;
};

struct GltfReadOptions {
  /// The node that is the target window, by name. Its node extras give the rectangle; without them,
  /// the +z face of its subtree's bounding box in the node's axes does. Without a name, the node
  /// whose extras say `target_window`, if there is one.
  std::optional<std::string> target_node = {};
  /// Which of the file's scenes. Without it, the file's default one or else the first.
  std::optional<int> scene_index = {};
  /// glTF gives cameras a field of view and no resolution.
  int camera_height_px = 480;

  // A file from outside may claim anything; these bound what reading it costs.
  size_t max_file_bytes = size_t{1} << 30;      ///< Of each file and of all of them together.
  size_t max_triangles = 20'000'000;            ///< After all instances are placed.
  size_t max_image_pixels = size_t{256} << 20;  ///< Of all decoded images together.
};

/// Reads .gltf or .glb (told apart by their content). Throws InputError, which names the file and
/// the place in it as a JSON pointer, for a file that breaks the rules of glTF 2.0, that requires
/// an extension which is not supported, or that exceeds the limits.
GltfScene ReadGltf(const std::filesystem::path& file, const GltfReadOptions& options = {});

/// Writes one self-contained file, JSON with embedded data for ".gltf" or binary for ".glb", that
/// appears by rename. Reading it gives the same meshes, materials, textures, windows, lamps and
/// cameras, bit for bit; the sun's angles to rounding. Meshes without triangles are left out, and
/// notes are not written. Throws InputError for another extension or where it cannot be written.
void WriteGltf(const std::filesystem::path& file, const GltfScene& scene);

}  // namespace fenestra
