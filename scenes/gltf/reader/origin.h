#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/placement.h"

namespace fenestra::gltf {

/// Surfaces are held in single precision, whose numbers are 8 µm apart at 100 m and 0.5 m at the
/// coordinates of a map. So a scene that stands further out than that is moved, in double
/// precision, before any of it is converted.
///
/// Chooses the place p_FW of the world's origin in the file's own frame F, whose axes are those of
/// W: the origin of F if the middle of the scene is within 100 m of it, else the whole metres
/// closest to that middle. The middle is the target window; without one, the median place of all
/// triangles, which a stray object does not move; without any, the first camera.
///
/// Notes what is lost before anything could be moved: vertices that the file itself has in single
/// precision far from their node, and what stands far from the rest of the scene.
Eigen::Vector3d ChooseOrigin(const Asset& asset, const std::vector<PlacedNode>& nodes,
                             const std::optional<std::string>& target_node, Notes& notes);

/// The nodes as they stand in W.
std::vector<PlacedNode> MovedTo(const Eigen::Vector3d& p_FW, std::vector<PlacedNode> nodes);

}  // namespace fenestra::gltf
