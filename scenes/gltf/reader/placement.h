#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/surfaces.h"

namespace fenestra::gltf {

/// A node with its place in the world. M_WN maps the node's coordinates to the world's; affine, not
/// always a rigid transform.
struct PlacedNode {
  size_t node = 0;
  Eigen::Matrix4d M_WN = Eigen::Matrix4d::Identity();
  bool is_visible = true;  ///< KHR_node_visibility, of the node and all its ancestors.
  size_t subtree_end = 0;  ///< Index behind its last descendant in the list of placed nodes.
};

/// All nodes of the chosen scene, each before its descendants, siblings in the document's order.
/// Throws InputError for a scene that does not exist and for transforms that overflow.
std::vector<PlacedNode> PlaceNodes(const Asset& asset, std::optional<int> scene_index);

/// A transform that is a rotation and translation after a scaling along the axes.
struct ScaledPose {
  Pose X_WN;
  Eigen::Vector3d scale;
};

/// nullopt for a sheared, mirrored or singular transform. A rigid transform keeps its bits.
std::optional<ScaledPose> RigidPart(const Eigen::Matrix4d& M_WN);

/// M_NI of each instance I of a node's mesh (see InstanceAttributes); the identity without the
/// extension. Throws InputError for a rotation that is none.
std::vector<Eigen::Matrix4d> InstanceTransforms(const Asset& asset, const tinygltf::Node& node);

/// Transform of each vertex of a skinned surface, by section 3.7.3.3 of the specification:
///
///     M_WV = Σ_k w_k M_WJk B_k,   Σ_k w_k = 1
///
/// of joints J and their inverse bind matrices B; the skinned node's own pose does not count. The
/// joints are in the file's rest pose. Throws InputError for a joint that does not exist and
/// for bind matrices that are not affine. `by_node` has an entry for each node of the document,
/// nullptr for one that is not in the scene.
std::vector<Eigen::Matrix4d> SkinTransforms(const Asset& asset, size_t skin, const Surface& surface,
                                            const std::vector<const PlacedNode*>& by_node);

}  // namespace fenestra::gltf
