#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "scenes/gltf/fault_list.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// What the schema cannot say. All of them take a model that passed CheckSchema, and
/// `buffer_lengths`, the buffers' stated sizes in bytes.

/// Views within their buffers, accessors within their views, alignment, strides. An accessor
/// without a view, all zeros, costs memory for nothing and is bounded.
void CheckAccessors(const tinygltf::Model& model, const std::vector<uint64_t>& buffer_lengths,
                    FaultList& faults);

/// Which attributes a primitive has, in which formats, and that they are equally long.
void CheckMeshes(const tinygltf::Model& model, FaultList& faults);

/// That nodes form a forest and scenes name its roots; skins, cameras, lights and animations.
void CheckNodes(const tinygltf::Model& model, const nlohmann::json& root, FaultList& faults);
void CheckSkins(const tinygltf::Model& model, FaultList& faults);
void CheckCamerasAndLights(const nlohmann::json& root, FaultList& faults);
void CheckAnimations(const nlohmann::json& root, FaultList& faults);

}  // namespace fenestra::gltf
