#pragma once

#include <optional>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/placement.h"

namespace fenestra::gltf {

struct Lights {
  std::optional<Sun> sun;  ///< The first directional light.
  std::vector<Lamp> lamps;
};

/// The lights of KHR_lights_punctual on visible nodes. They shine along the -z axis of their node.
Lights ReadLights(const Asset& asset, const std::vector<PlacedNode>& nodes, Notes& notes);

}  // namespace fenestra::gltf
