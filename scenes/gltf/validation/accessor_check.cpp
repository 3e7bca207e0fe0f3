#include <fmt/format.h>

#include "scenes/gltf/validation/structure_check.h"

namespace fenestra::gltf {
namespace {

// Most zeros without data behind them: enough for a sparse morph target of a large mesh.
constexpr uint64_t kMostUndefinedComponents = 30'000'000;

// The schema keeps all sizes below 2^53 and strides below 2^8, so that no sum below overflows.

void CheckView(const tinygltf::BufferView& view, uint64_t buffer_length, const std::string& at,
               Faults& faults) {
  const uint64_t end = uint64_t{view.byteOffset} + view.byteLength;
  if (end > buffer_length) {
    faults.Add(at, fmt::format("ends at byte {} of a buffer of {} bytes", end, buffer_length));
  }
  if (view.byteStride == 0) return;
  if (view.byteStride % 4 != 0) {
    faults.Add(at + "/byteStride", fmt::format("must be a multiple of 4, not {}", view.byteStride));
  }
  if (view.byteStride > view.byteLength) {
    faults.Add(at + "/byteStride", fmt::format("{} bytes are more than the view's {}",
                                               view.byteStride, view.byteLength));
  }
}

// Elements of one accessor, or the indices or values of a sparse one, in their view.
struct Span {
  int view;
  uint64_t byte_offset;
  uint64_t count;
  ElementLayout layout;
};

void CheckSpan(const tinygltf::Model& model, const Span& span, const std::string& at,
               Faults& faults) {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(span.view)];
  const uint32_t size = span.layout.component_bytes;
  if (span.byte_offset % size != 0) {
    faults.Add(
        at + "/byteOffset",
        fmt::format("{} is not a multiple of the {} bytes of a component", span.byte_offset, size));
  } else if ((view.byteOffset + span.byte_offset) % size != 0) {
    faults.Add(at, fmt::format("begins at byte {} of its buffer, not a multiple of the {} bytes of "
                               "a component",
                               view.byteOffset + span.byte_offset, size));
  }
  const uint64_t stride = view.byteStride != 0 ? view.byteStride : span.layout.PackedStride();
  if (stride < span.layout.Bytes()) {
    faults.Add(at, fmt::format("its view's stride of {} bytes is less than an element's {}", stride,
                               span.layout.Bytes()));
  }
  const uint64_t end = span.byte_offset + stride * (span.count - 1) + span.layout.Bytes();
  if (end > view.byteLength) {
    faults.Add(at, fmt::format("ends at byte {} of /bufferViews/{}, which has {}", end, span.view,
                               view.byteLength));
  }
}

void CheckHasNoStride(const tinygltf::Model& model, int view, const std::string& at,
                      Faults& faults) {
  if (model.bufferViews[static_cast<size_t>(view)].byteStride == 0) return;
  faults.Add(at, fmt::format("/bufferViews/{} must not have a stride", view));
}

void CheckSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                 const std::string& at, Faults& faults) {
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<uint64_t>(sparse.count);
  if (sparse.count < 1 || count > accessor.count) {
    faults.Add(at + "/count", fmt::format("must be 1 to {}, the accessor's count, not {}",
                                          accessor.count, sparse.count));
    return;
  }
  CheckHasNoStride(model, sparse.indices.bufferView, at + "/indices", faults);
  CheckHasNoStride(model, sparse.values.bufferView, at + "/values", faults);
  CheckSpan(model,
            {.view = sparse.indices.bufferView,
             .byte_offset = static_cast<uint64_t>(sparse.indices.byteOffset),
             .count = count,
             .layout = LayoutOf(sparse.indices.componentType, TINYGLTF_TYPE_SCALAR)},
            at + "/indices", faults);
  CheckSpan(model,
            {.view = sparse.values.bufferView,
             .byte_offset = static_cast<uint64_t>(sparse.values.byteOffset),
             .count = count,
             .layout = LayoutOf(accessor.componentType, accessor.type)},
            at + "/values", faults);
}

}  // namespace

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

void CheckAccessors(const tinygltf::Model& model, const std::vector<uint64_t>& buffer_lengths,
                    Faults& faults) {
  for (size_t i = 0; i < model.bufferViews.size(); ++i) {
    const tinygltf::BufferView& view = model.bufferViews[i];
    CheckView(view, buffer_lengths[static_cast<size_t>(view.buffer)],
              fmt::format("/bufferViews/{}", i), faults);
  }
  for (size_t i = 0; i < model.accessors.size(); ++i) {
    const tinygltf::Accessor& accessor = model.accessors[i];
    const std::string at = fmt::format("/accessors/{}", i);
    const ElementLayout layout = LayoutOf(accessor.componentType, accessor.type);
    if (accessor.bufferView >= 0) {
      CheckSpan(model,
                {.view = accessor.bufferView,
                 .byte_offset = accessor.byteOffset,
                 .count = accessor.count,
                 .layout = layout},
                at, faults);
    } else if (accessor.count > kMostUndefinedComponents / layout.ComponentCount()) {
      faults.Add(at + "/count",
                 fmt::format("{} elements without data; at most {} are read", accessor.count,
                             kMostUndefinedComponents / layout.ComponentCount()));
    }
    if (accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                                accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
      faults.Add(at + "/normalized", "only integers of 8 or 16 bits may be normalised");
    }
    for (const auto& [name, bounds] :
         {std::pair("min", &accessor.minValues), std::pair("max", &accessor.maxValues)}) {
      if (bounds->empty() || bounds->size() == layout.ComponentCount()) continue;
      faults.Add(
          fmt::format("{}/{}", at, name),
          fmt::format("must have {} elements, not {}", layout.ComponentCount(), bounds->size()));
    }
    if (accessor.sparse.isSparse) CheckSparse(model, accessor, at + "/sparse", faults);
  }
}

}  // namespace fenestra::gltf
