#pragma once

#include <Eigen/Core>
#include <cstddef>
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

/// The contents of a glTF file in Fenestra's terms. docs/gltf.md describes the mapping.
struct GltfScene {
  /// In the world frame W. A file that stands far from the origin of its own frame F is moved: the
  /// origin of W is p_FW there, and the axes are the same.
  Scene scene;
  std::vector<SceneCamera> cameras;
  std::optional<Sun> sun;
  /// One sentence for each thing in the file that Fenestra leaves out or approximates.
  std::vector<std::string> notes;
  Eigen::Vector3d p_FW = Eigen::Vector3d::Zero();  ///< Whole metres.
};

struct GltfReadOptions {
  /// The node that is the target window, by name. Its node extras give the rectangle; without them,
  /// the +z face of its subtree's bounding box in the node's axes does. Without a name, the node
  /// whose extras say `target_window`, if there is one.
  std::optional<std::string> target_node = {};
  /// Index of the scene to be read. Without it, the file's default scene or else the first.
  std::optional<int> scene_index = {};
  /// Image height of all cameras, since glTF states a field of view but no resolution.
  int camera_height_px = 480;

  // Limits on the cost of reading a file from outside, which may claim anything.
  size_t max_file_bytes = size_t{1} << 30;      ///< For each file, and for all of them together.
  size_t max_memory_bytes = 1'000'000'000;      ///< Estimated, from reading to rendering.
  size_t max_triangles = 20'000'000;            ///< After all instances are placed.
  size_t max_image_pixels = size_t{256} << 20;  ///< For all decoded images together.
};

}  // namespace fenestra
