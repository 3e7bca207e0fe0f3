#include "scenes/gltf/reader/textures.h"

#include <fmt/format.h>

#include <array>

#include "core/io/srgb.h"

namespace fenestra::gltf {
namespace {

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
