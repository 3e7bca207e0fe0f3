#include "scenes/gltf/validation/element_layout.h"

namespace fenestra::gltf {

ElementLayout LayoutOf(int component_type, int type) {
  ElementLayout layout;
  layout.component_bytes = static_cast<uint32_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component_type)));
  const bool is_matrix =
      type == TINYGLTF_TYPE_MAT2 || type == TINYGLTF_TYPE_MAT3 || type == TINYGLTF_TYPE_MAT4;
  if (is_matrix) {
    layout.columns = type == TINYGLTF_TYPE_MAT2 ? 2 : type == TINYGLTF_TYPE_MAT3 ? 3 : 4;
    layout.rows = layout.columns;
  } else {
    layout.rows =
        static_cast<uint32_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
  }
  layout.column_bytes = layout.rows * layout.component_bytes;
  if (is_matrix) layout.column_bytes = (layout.column_bytes + 3) / 4 * 4;
  return layout;
}

}  // namespace fenestra::gltf
