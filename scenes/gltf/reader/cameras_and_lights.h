#pragma once

#include <optional>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/placement.h"

namespace fenestra::gltf {

/// The perspective cameras of the placed nodes. With Fenestra's camera extras they are as they were
/// written; without them, each is a pinhole of the file's field of view, `height_px` high and
/// centred, whose pixels are square.
std::vector<SceneCamera> ReadCameras(const Asset& asset, const std::vector<PlacedNode>& nodes,
                                     int height_px, Notes& notes);

/// From glTF's camera axes G (+x right, +y up, looking along -z) to OpenCV's, C. Its own inverse.
inline Pose FlipCameraAxes(const Pose& X_WG) {
  Eigen::Matrix3d R_WC = X_WG.rotation();
  R_WC.rightCols<2>() *= -1.0;
  return Pose(R_WC, X_WG.translation());
}

struct Lights {
  std::optional<Sun> sun;  ///< The first directional light.
  std::vector<Lamp> lamps;
};

/// The lights of KHR_lights_punctual on visible nodes. They shine along the -z axis of their node.
Lights ReadLights(const Asset& asset, const std::vector<PlacedNode>& nodes, Notes& notes);

}  // namespace fenestra::gltf
