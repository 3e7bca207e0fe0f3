#pragma once

#include <optional>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/meshes.h"
#include "scenes/gltf/reader/placement.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

struct Windows {
  std::optional<TargetWindow> target;
  std::vector<TargetWindow> others;
};

/// The windows that node extras mark, and the target that `target_node` names: then a node that the
/// file marks as target is one of the others. Throws InputError, with all faults, for a node name
/// that is unknown or not unique, a second target, and a window that is sheared, mirrored or flat
/// to a line.
Windows FindWindows(const Asset& asset, const std::vector<PlacedNode>& nodes,
                    const PlacedMeshes& meshes, const std::optional<std::string>& target_node);

}  // namespace fenestra::gltf
