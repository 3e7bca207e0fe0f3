#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/io/faults.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {

/// Memory layout of one element of an accessor. Matrix columns begin at multiples of four bytes.
struct ElementLayout {
  uint32_t component_bytes = 0;
  uint32_t columns = 1;
  uint32_t rows = 1;  ///< Components of a vector, or of each column of a matrix.
  uint32_t column_bytes = 0;

  uint32_t ComponentCount() const { return columns * rows; }
  /// Bytes from the beginning of an element to its end.
  uint32_t Bytes() const { return (columns - 1) * column_bytes + rows * component_bytes; }
  /// Bytes from one element to the next if the buffer view states no stride.
  uint32_t PackedStride() const { return columns * column_bytes; }
};

ElementLayout LayoutOf(int component_type, int type);

/// Holds the whole document against the schema: types, ranges, required members, references into
/// arrays, and extensions that are misplaced or not declared.
void CheckSchema(const nlohmann::json& root, Faults& faults);

/// Checks of rules that the schema cannot express. All of them take a model that passed
/// CheckSchema.

/// Checks that views lie within their buffers, whose stated sizes in bytes are `buffer_lengths`,
/// and accessors within their views; alignment and strides. The size of accessors without a view,
/// which are all zeros, is limited, too.
void CheckAccessors(const tinygltf::Model& model, const std::vector<uint64_t>& buffer_lengths,
                    Faults& faults);

/// Checks which attributes a primitive has, their formats, and that they are equally long.
void CheckMeshes(const tinygltf::Model& model, Faults& faults);

/// Checks that nodes form a forest and scenes name its roots; skins, cameras, lights, animations.
void CheckNodes(const tinygltf::Model& model, const nlohmann::json& root, Faults& faults);
void CheckSkins(const tinygltf::Model& model, Faults& faults);
void CheckCamerasAndLights(const nlohmann::json& root, Faults& faults);
void CheckAnimations(const nlohmann::json& root, Faults& faults);

}  // namespace fenestra::gltf
