#include "scenes/gltf/writer/buffer_builder.h"

#include <algorithm>

namespace fenestra::gltf {
namespace {

constexpr int kNoTarget = 0;

template <typename T>
std::span<const uint8_t> BytesOf(const std::vector<T>& values) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
  return {reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)};
}

// The least and the largest of each component.
template <typename Vector>
void SetBounds(const std::vector<Vector>& values, tinygltf::Accessor& accessor) {
  for (glm::length_t i = 0; i < Vector::length(); ++i) {
    const auto [low, high] = std::ranges::minmax(values, {}, [i](const Vector& v) { return v[i]; });
    accessor.minValues.push_back(low[i]);
    accessor.maxValues.push_back(high[i]);
  }
}

}  // namespace

int BufferBuilder::AddVertices(const std::vector<glm::vec3>& values) {
  tinygltf::Accessor accessor;
  accessor.bufferView = AddView(BytesOf(values), TINYGLTF_TARGET_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = TINYGLTF_TYPE_VEC3;
  accessor.count = values.size();
  SetBounds(values, accessor);
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int BufferBuilder::AddVertices(const std::vector<glm::vec2>& values) {
  tinygltf::Accessor accessor;
  accessor.bufferView = AddView(BytesOf(values), TINYGLTF_TARGET_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = TINYGLTF_TYPE_VEC2;
  accessor.count = values.size();
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int BufferBuilder::AddTriangles(const std::vector<glm::uvec3>& triangles) {
  tinygltf::Accessor accessor;
  accessor.bufferView = AddView(BytesOf(triangles), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = 3 * triangles.size();
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int BufferBuilder::AddBytes(std::span<const uint8_t> bytes) {
  return AddView(bytes, kNoTarget);
}

int BufferBuilder::AddView(std::span<const uint8_t> bytes, int target) {
  std::vector<unsigned char>& data = model_.buffers[0].data;
  data.resize((data.size() + 3) / 4 * 4);  // All our components have 4 bytes.
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = bytes.size();
  view.target = target;
  data.insert(data.end(), bytes.begin(), bytes.end());
  model_.bufferViews.push_back(std::move(view));
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

}  // namespace fenestra::gltf
