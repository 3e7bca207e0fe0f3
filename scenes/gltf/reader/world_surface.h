#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/gltf/reader/surfaces.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

/// A surface transformed into the world by M_WM or, if it is skinned, each vertex by a transform of
/// its own. The caller sets name, material and `closed` of the mesh. If one normal has no
/// direction, the mesh has no normals at all.
Mesh CarryToWorld(const Surface& surface, const Eigen::Matrix4d& M_WM);
Mesh CarryToWorld(const Surface& surface, const std::vector<Eigen::Matrix4d>& M_WM_of_vertex);

}  // namespace fenestra::gltf
