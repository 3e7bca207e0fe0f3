#include "scenes/gltf/reader/materials.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

#include "scenes/gltf/reader/textures.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {
namespace {

// Weights of the luminance of linear Rec. 709 colours.
double Luminance(const glm::dvec3& rgb) {
  return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 Rgb(const std::vector<double>& values) {
  return {values[0], values[1], values[2]};
}

bool IsUnlit(const tinygltf::Material& source) {
  return source.extensions.contains("KHR_materials_unlit");
}

double Transmission(const tinygltf::Material& source) {
  return ExtensionNumberOr(source.extensions, "KHR_materials_transmission", "transmissionFactor",
                           0.0);
}

bool IsGlass(const tinygltf::Material& source) {
  return !IsUnlit(source) && Transmission(source) > 0.5;
}

// Emission [cd/m²] without its texture.
glm::dvec3 Emission(const tinygltf::Material& source) {
  return Rgb(source.emissiveFactor) * ExtensionNumberOr(source.extensions,
                                                        "KHR_materials_emissive_strength",
                                                        "emissiveStrength", 1.0);
}

// A surface of Fenestra's has one texture for what it reflects and what it emits; a glTF material
// may have two. This decides which one it is.
struct Textures {
  std::optional<TextureUse> base;
  std::optional<TextureUse> emissive;
  std::optional<TextureUse> chosen;
  bool emission_is_approximated = false;
};

Textures ChooseTextures(const tinygltf::Model& model, const tinygltf::Material& source) {
  Textures t;
  if (IsGlass(source)) return t;
  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
  t.base = ReadTextureUse(model, pbr.baseColorTexture);
  t.chosen = t.base;
  if (IsUnlit(source) || Emission(source) == glm::dvec3(0.0)) return t;
  t.emissive = ReadTextureUse(model, source.emissiveTexture);
  if (t.base == t.emissive) return t;
  if (Rgb(pbr.baseColorFactor) == glm::dvec3(0.0)) {
    t.chosen = t.emissive;
  } else {
    t.emission_is_approximated = true;
  }
  return t;
}

// The emission whose mean over the surface is right, though another texture modulates it.
glm::dvec3 MeanEmission(const Textures& t, const glm::dvec3& emission, TextureShelf& shelf) {
  glm::dvec3 mean = emission;
  if (t.emissive) mean *= shelf.MeanLinear(t.emissive->texture);
  if (!t.base) return mean;
  const glm::dvec3 base = shelf.MeanLinear(t.base->texture);
  for (int c = 0; c < 3; ++c) mean[c] = base[c] > 0.0 ? mean[c] / base[c] : 0.0;
  return mean;
}

void ConvertGlass(const tinygltf::Material& source, const std::string& name, Material& material,
                  Notes& notes) {
  material.kind = Material::Kind::kGlass;
  double index =
      ExtensionNumberOr(source.extensions, "KHR_materials_ior", "ior", kDefaultIndexOfRefraction);
  if (index < 1.0) {
    notes.Add("an index of refraction below 1 is taken as 1.5", name);
    index = kDefaultIndexOfRefraction;
  }
  material.refractive_index = static_cast<float>(index);
  if (Rgb(source.pbrMetallicRoughness.baseColorFactor) != glm::dvec3(1.0) ||
      source.pbrMetallicRoughness.baseColorTexture.index >= 0) {
    notes.Add("glass is clear; its tint is left out", name);
  }
}

void ConvertOpaque(const tinygltf::Material& source, const Textures& textures,
                   const std::string& name, TextureShelf& shelf, Material& material, Notes& notes) {
  const glm::dvec3 base = Rgb(source.pbrMetallicRoughness.baseColorFactor);
  glm::dvec3 emission = Emission(source);
  if (IsUnlit(source)) {
    emission = base * kUnlitWhite_cd_per_m2;
    notes.Add(
        fmt::format("unlit, so it shines with {} cd/m² where it is white", kUnlitWhite_cd_per_m2),
        name);
  } else {
    material.reflectance_rgb = base;
    material.reflectance_830nm = static_cast<float>(Luminance(base));
  }
  if (textures.emission_is_approximated) {
    emission = MeanEmission(textures, emission, shelf);
    notes.Add("the emission has its right mean, but the base colour's texture", name);
  }
  material.emission_rgb = emission;
  if (textures.chosen) material.texture = shelf.IndexOf(textures.chosen->texture);
  const auto ours = [&](const char* member, double otherwise) {
    return static_cast<float>(NumberOr(Find(source.extras, {"fenestra", member}), otherwise));
  };
  material.reflectance_830nm = ours("reflectance_830nm", material.reflectance_830nm);
  material.emission_830nm = ours("emission_830nm", 0.0);
}

void ConvertAlpha(const tinygltf::Material& source, const std::string& name, ReadMaterial& read,
                  Notes& notes) {
  if (source.alphaMode == "OPAQUE" || read.material.kind == Material::Kind::kGlass) return;
  double cutoff = source.alphaCutoff;
  if (source.alphaMode == "BLEND") {
    cutoff = kBlendCutoff;
    notes.Add(fmt::format("alpha is not blended but cut at {}", kBlendCutoff), name);
  }
  const double alpha = source.pbrMetallicRoughness.baseColorFactor[3];
  if (alpha < cutoff) {
    read.is_invisible = true;
    notes.Add("transparent everywhere, so it is left out", name);
    return;
  }
  // alpha · texel < cutoff  <=>  texel < cutoff / alpha.
  read.material.alpha_cutoff = cutoff > 0.0 ? static_cast<float>(cutoff / alpha) : 0.0f;
}

void NoteTheRest(const tinygltf::Material& source, const std::string& name, Notes& notes) {
  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
  if (IsUnlit(source) || IsGlass(source)) return;
  if (pbr.metallicFactor > 0.0) notes.Add("metal is rendered as matt paint of its colour", name);
  if (source.normalTexture.index >= 0) notes.Add("its normal map is left out", name);
  if (Transmission(source) > 0.0) notes.Add("little transmission is taken as none", name);
}

}  // namespace

ReadMaterials ConvertMaterials(const Asset& asset, size_t max_image_pixels, Notes& notes) {
  const std::vector<tinygltf::Material>& sources = asset.model.materials;
  std::vector<Textures> textures;
  std::set<int> needed;
  for (const tinygltf::Material& source : sources) {
    textures.push_back(ChooseTextures(asset.model, source));
    if (textures.back().chosen) needed.insert(textures.back().chosen->texture);
  }
  TextureShelf shelf(asset, max_image_pixels);
  shelf.Load(needed);
  ReadMaterials result;
  for (size_t i = 0; i < sources.size(); ++i) {
    const std::string name = Named("material", sources[i].name, i);
    ReadMaterial& read = result.materials.emplace_back();
    read.material.name = sources[i].name;
    read.texture = textures[i].chosen;
    if (IsGlass(sources[i])) {
      ConvertGlass(sources[i], name, read.material, notes);
    } else {
      ConvertOpaque(sources[i], textures[i], name, shelf, read.material, notes);
    }
    ConvertAlpha(sources[i], name, read, notes);
    NoteTheRest(sources[i], name, notes);
  }
  result.textures = shelf.Take();
  return result;
}

Material DefaultMaterial() {
  Material material;
  material.name = "default";
  material.reflectance_rgb = glm::vec3(1.0f);
  material.reflectance_830nm = 1.0f;
  return material;
}

}  // namespace fenestra::gltf
