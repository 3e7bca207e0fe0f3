#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/placement.h"
#include "scenes/gltf/reader/surfaces.h"

namespace fenestra::gltf {

/// Where each vertex of a skinned surface stands, by section 3.7.3.3 of the specification:
///
///     M_WV = Σ_k w_k M_WJk B_k,   Σ_k w_k = 1
///
/// of joints J and their inverse bind matrices B; the skinned node's own place does not count. The
/// joints stand as the file has them at rest. Throws InputError for a joint that does not exist and
/// for bind matrices that are not affine. `by_node` has the document's nodes, nullptr where one is
/// not in the scene.
std::vector<Eigen::Matrix4d> SkinTransforms(const Asset& asset, size_t skin, const Surface& surface,
                                            const std::vector<const PlacedNode*>& by_node);

}  // namespace fenestra::gltf
