#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/io/faults.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// What the schema cannot say. All of them take a model that passed CheckSchema, and
/// `buffer_lengths`, the buffers' stated sizes in bytes.

/// Views within their buffers, accessors within their views, alignment, strides. An accessor
/// without a view, all zeros, costs memory for nothing and is bounded.
void CheckAccessors(const tinygltf::Model& model, const std::vector<uint64_t>& buffer_lengths,
                    Faults& faults);

/// Which attributes a primitive has, in which formats, and that they are equally long.
void CheckMeshes(const tinygltf::Model& model, Faults& faults);

/// That nodes form a forest and scenes name its roots; skins, cameras, lights and animations.
void CheckNodes(const tinygltf::Model& model, const nlohmann::json& root, Faults& faults);
void CheckSkins(const tinygltf::Model& model, Faults& faults);
void CheckCamerasAndLights(const nlohmann::json& root, Faults& faults);
void CheckAnimations(const nlohmann::json& root, Faults& faults);

}  // namespace fenestra::gltf
