#include "scenes/gltf/reader/textures.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/io/srgb.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {
namespace {

glm::dvec2 PairOr(const tinygltf::Value& object, const char* name, const glm::dvec2& otherwise) {
  const tinygltf::Value* pair = Find(object, {name});
  if (pair == nullptr) return otherwise;
  return {pair->Get(0).GetNumberAsDouble(), pair->Get(1).GetNumberAsDouble()};
}

Texture::Wrap WrapOf(int code) {
  switch (code) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Texture::Wrap::kClampToEdge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Texture::Wrap::kMirroredRepeat;
    default:
      return Texture::Wrap::kRepeat;
  }
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

void TextureShelf::Load(const std::set<int>& textures) {
  for (const int index : textures) {
    const tinygltf::Texture& source = asset_.model.textures[static_cast<size_t>(index)];
    const bool is_copy = pictures_.contains(source.source);
    const Picture& picture = PictureOf(index);
    if (is_copy && !budget_.Take(picture.texels.size())) {
      throw InputError(asset_.file,
                       fmt::format("/textures/{}: more pixels than are read for one scene", index));
    }
    Texture texture{.name = source.name,
                    .width_px = picture.width_px,
                    .height_px = picture.height_px,
                    .texels = picture.texels};
    if (source.sampler >= 0) {
      const auto& sampler = asset_.model.samplers[static_cast<size_t>(source.sampler)];
      texture.wrap_u = WrapOf(sampler.wrapS);
      texture.wrap_v = WrapOf(sampler.wrapT);
      texture.interpolated = sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    indices_[index] = static_cast<uint32_t>(textures_.size());
    textures_.push_back(std::move(texture));
  }
}

glm::dvec3 TextureShelf::MeanLinear(int texture) {
  const Picture& picture = PictureOf(texture);
  std::array<std::array<size_t, 256>, 3> histograms{};
  for (const glm::u8vec4& texel : picture.texels) {
    for (int c = 0; c < 3; ++c) ++histograms[static_cast<size_t>(c)][texel[c]];
  }
  glm::dvec3 mean(0.0);
  for (int c = 0; c < 3; ++c) {
    for (int code = 0; code < 256; ++code) {
      mean[c] += LinearFromSrgb(code / 255.0) *
                 static_cast<double>(histograms[static_cast<size_t>(c)][static_cast<size_t>(code)]);
    }
  }
  return mean / static_cast<double>(picture.texels.size());
}

const Picture& TextureShelf::PictureOf(int texture) {
  const int image = asset_.model.textures[static_cast<size_t>(texture)].source;
  const auto found = pictures_.find(image);
  if (found != pictures_.end()) return found->second;
  Picture picture = DecodeImage(asset_, static_cast<size_t>(image), budget_);
  return pictures_.emplace(image, std::move(picture)).first->second;
}

}  // namespace fenestra::gltf
