#include "scenes/gltf/reader/texture_use.h"

#include <cmath>

#include "scenes/gltf/file/values.h"

namespace fenestra::gltf {
namespace {

glm::dvec2 PairOr(const tinygltf::Value& object, const char* name, const glm::dvec2& otherwise) {
  const tinygltf::Value* pair = Find(object, {name});
  if (pair == nullptr) return otherwise;
  return {pair->Get(0).GetNumberAsDouble(), pair->Get(1).GetNumberAsDouble()};
}

}  // namespace

glm::vec2 TextureUse::Apply(const glm::vec2& uv) const {
  // Without a transform the coordinates keep their bits.
  if (offset == glm::dvec2(0.0) && scale == glm::dvec2(1.0) && rotation_rad == 0.0) return uv;
  const double c = std::cos(rotation_rad);
  const double s = std::sin(rotation_rad);
  const glm::dvec2 scaled = scale * glm::dvec2(uv);
  return {offset.x + c * scaled.x + s * scaled.y, offset.y - s * scaled.x + c * scaled.y};
}

std::optional<TextureUse> ReadTextureUse(const tinygltf::Model& model,
                                         const tinygltf::TextureInfo& info) {
  if (info.index < 0 || model.textures[static_cast<size_t>(info.index)].source < 0) {
    return std::nullopt;
  }
  TextureUse use{.texture = info.index, .coordinate_set = info.texCoord};
  const tinygltf::Value* transform = Extension(info.extensions, "KHR_texture_transform");
  if (transform == nullptr) return use;
  use.offset = PairOr(*transform, "offset", use.offset);
  use.scale = PairOr(*transform, "scale", use.scale);
  use.rotation_rad = NumberOr(Find(*transform, {"rotation"}), 0.0);
  use.coordinate_set =
      static_cast<int>(NumberOr(Find(*transform, {"texCoord"}), use.coordinate_set));
  return use;
}

}  // namespace fenestra::gltf
