#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/gltf/reader/surfaces.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

/// A surface carried into the world by M_WM, or each vertex by a transform of its own where it is
/// skinned. Name, material and `closed` of the mesh are left to the caller. Where a normal has no
/// direction, the mesh has none at all.
Mesh CarryToWorld(const Surface& surface, const Eigen::Matrix4d& M_WM);
Mesh CarryToWorld(const Surface& surface, const std::vector<Eigen::Matrix4d>& M_WM_of_vertex);

}  // namespace fenestra::gltf
