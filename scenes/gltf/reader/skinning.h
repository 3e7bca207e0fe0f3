#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/placement.h"
#include "scenes/gltf/reader/surfaces.h"

namespace fenestra::gltf {

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
