#pragma once

#include <cstdint>

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

}  // namespace fenestra::gltf
