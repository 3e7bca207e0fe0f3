#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/io/faults.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// How one element of an accessor lies in memory. Matrix columns begin at multiples of four bytes.
struct ElementLayout {
  uint32_t component_bytes = 0;
  uint32_t columns = 1;
  uint32_t rows = 1;  ///< Components of a vector, or of each column of a matrix.
  uint32_t column_bytes = 0;

  uint32_t ComponentCount() const { return columns * rows; }
  /// From an element's first byte to behind its last one.
  uint32_t Bytes() const { return (columns - 1) * column_bytes + rows * component_bytes; }
  /// From one element to the next where the buffer view does not say.
  uint32_t PackedStride() const { return columns * column_bytes; }
};

ElementLayout LayoutOf(int component_type, int type);

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
