#include "scenes/gltf/reader/accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/input_error.h"
#include "scenes/gltf/tinygltf.h"
#include "scenes/gltf/validation/structure_check.h"

namespace fenestra::gltf {
namespace {

const tinygltf::Accessor& AccessorAt(const Asset& asset, int index) {
  return asset.model.accessors[static_cast<size_t>(index)];
}

[[noreturn]] void Refuse(const Asset& asset, const std::string& at, const std::string& reason) {
  throw InputError(asset.file, at + ": " + reason);
}

// First byte of the view's data; LoadAsset has checked that all elements lie within.
const uint8_t* DataOf(const Asset& asset, int view_index) {
  const tinygltf::BufferView& view = asset.model.bufferViews[static_cast<size_t>(view_index)];
  const std::optional<Bytes>& buffer = asset.buffers[static_cast<size_t>(view.buffer)];
  if (!buffer) Refuse(asset, fmt::format("/buffers/{}", view.buffer), "has no data");
  return buffer->data() + view.byteOffset;
}

template <typename Integer>
float ComponentAs(const uint8_t* at, bool normalized, float*) {
  const auto value = LoadLittleEndian<Integer>(at);
  if (!normalized) return static_cast<float>(value);
  constexpr double kLargest = std::numeric_limits<Integer>::max();
  return static_cast<float>(std::max(value / kLargest, -1.0));
}

template <typename Integer>
uint32_t ComponentAs(const uint8_t* at, bool, uint32_t*) {
  return static_cast<uint32_t>(LoadLittleEndian<Integer>(at));
}

template <typename T>
T Component(const uint8_t* at, int type, bool normalized) {
  T* const as = nullptr;
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return ComponentAs<int8_t>(at, normalized, as);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return ComponentAs<uint8_t>(at, normalized, as);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return ComponentAs<int16_t>(at, normalized, as);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return ComponentAs<uint16_t>(at, normalized, as);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return ComponentAs<uint32_t>(at, normalized, as);
    default:
      return static_cast<T>(LoadLittleEndian<float>(at));
  }
}

template <typename T>
struct Target {
  const tinygltf::Accessor& accessor;
  const ElementLayout layout;
  std::vector<T> values;

  void Element(size_t element, const uint8_t* at) {
    T* out = &values[element * layout.ComponentCount()];
    for (size_t column = 0; column < layout.columns; ++column) {
      for (size_t row = 0; row < layout.rows; ++row) {
        *out++ = Component<T>(at + column * layout.column_bytes + row * layout.component_bytes,
                              accessor.componentType, accessor.normalized);
      }
    }
  }
};

template <typename T>
void ApplySparse(const Asset& asset, int index, Target<T>& target) {
  const auto& sparse = target.accessor.sparse;
  const uint8_t* indices =
      DataOf(asset, sparse.indices.bufferView) + static_cast<size_t>(sparse.indices.byteOffset);
  const uint8_t* values =
      DataOf(asset, sparse.values.bufferView) + static_cast<size_t>(sparse.values.byteOffset);
  const ElementLayout index_layout = LayoutOf(sparse.indices.componentType, TINYGLTF_TYPE_SCALAR);
  int64_t last = -1;
  for (size_t i = 0; i < static_cast<size_t>(sparse.count); ++i) {
    const auto element = Component<uint32_t>(indices + i * index_layout.PackedStride(),
                                             sparse.indices.componentType, false);
    if (element <= last || element >= target.accessor.count) {
      Refuse(asset, fmt::format("/accessors/{}/sparse/indices", index),
             fmt::format("{} follows {}; they must ascend and be below {}", element, last,
                         target.accessor.count));
    }
    last = element;
    target.Element(element, values + i * target.layout.PackedStride());
  }
}

template <typename T>
std::vector<T> Read(const Asset& asset, int index) {
  const tinygltf::Accessor& accessor = AccessorAt(asset, index);
  Target<T> target{accessor, LayoutOf(accessor.componentType, accessor.type), {}};
  target.values.assign(accessor.count * target.layout.ComponentCount(), T{});
  if (accessor.bufferView >= 0) {
    const size_t stated =
        asset.model.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
    const size_t stride = stated != 0 ? stated : target.layout.PackedStride();
    const uint8_t* data = DataOf(asset, accessor.bufferView) + accessor.byteOffset;
    for (size_t i = 0; i < accessor.count; ++i) target.Element(i, data + i * stride);
  }
  if (accessor.sparse.isSparse) ApplySparse(asset, index, target);
  return std::move(target.values);
}

// A list of vectors of the accessor's floats.
template <typename Vector>
std::vector<Vector> ReadVectors(const Asset& asset, int accessor) {
  const std::vector<float> floats = ReadFloats(asset, accessor);
  constexpr size_t kLength = Vector::length();
  std::vector<Vector> vectors(floats.size() / kLength);
  for (size_t i = 0; i < vectors.size(); ++i) {
    for (size_t k = 0; k < kLength; ++k) {
      vectors[i][static_cast<glm::length_t>(k)] = floats[i * kLength + k];
    }
  }
  return vectors;
}

}  // namespace

std::vector<float> ReadFloats(const Asset& asset, int accessor) {
  std::vector<float> values = Read<float>(asset, accessor);
  const auto bad = std::ranges::find_if(values, [](float x) { return !std::isfinite(x); });
  if (bad != values.end()) {
    const tinygltf::Accessor& a = AccessorAt(asset, accessor);
    const auto components = LayoutOf(a.componentType, a.type).ComponentCount();
    Refuse(asset, fmt::format("/accessors/{}", accessor),
           fmt::format("element {} is not finite", (bad - values.begin()) / components));
  }
  return values;
}

std::vector<glm::vec2> ReadVec2(const Asset& asset, int accessor) {
  return ReadVectors<glm::vec2>(asset, accessor);
}

std::vector<glm::vec3> ReadVec3(const Asset& asset, int accessor) {
  return ReadVectors<glm::vec3>(asset, accessor);
}

std::vector<glm::vec4> ReadVec4(const Asset& asset, int accessor) {
  if (AccessorAt(asset, accessor).type == TINYGLTF_TYPE_VEC4) {
    return ReadVectors<glm::vec4>(asset, accessor);
  }
  std::vector<glm::vec4> vectors;
  for (const glm::vec3& v : ReadVec3(asset, accessor)) vectors.emplace_back(v, 1.0f);
  return vectors;
}

std::vector<uint32_t> ReadUnsigned(const Asset& asset, int accessor) {
  return Read<uint32_t>(asset, accessor);
}

bool HasTriangles(int mode) {
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

size_t TriangleCount(int mode, size_t vertices) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return vertices / 3;
  return vertices < 3 ? 0 : vertices - 2;
}

std::vector<glm::uvec3> Triangles(int mode, const std::vector<uint32_t>& vertices) {
  const std::vector<uint32_t>& v = vertices;
  std::vector<glm::uvec3> triangles;
  const size_t count = TriangleCount(mode, v.size());
  triangles.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    glm::uvec3 t;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      t = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      t = {v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]};
    } else {
      t = {v[i + 1], v[i + 2], v[0]};
    }
    if (t.x != t.y && t.y != t.z && t.z != t.x) triangles.push_back(t);
  }
  return triangles;
}

}  // namespace fenestra::gltf
