#pragma once

#include <optional>
#include <vector>

#include "scenes/gltf/reader/asset.h"
#include "scenes/gltf/reader/textures.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

/// Luminance of an unlit surface (KHR_materials_unlit) of colour 1: about white paint on a facade
/// under an overcast sky. glTF gives unlit colours no unit.
inline constexpr double kUnlitWhite_cd_per_m2 = 100.0;

/// Where an alpha-blended surface is cut, as Fenestra's surfaces are there or not.
inline constexpr double kBlendCutoff = 0.5;

/// glTF's index of refraction where a file does not state it.
inline constexpr double kDefaultIndexOfRefraction = 1.5;

/// A material of the document, as a surface of Fenestra's.
struct ReadMaterial {
  Material material;
  std::optional<TextureUse> texture;  ///< How material.texture lies on the mesh.
  bool is_invisible = false;          ///< Its alpha is below the cutoff everywhere.
};

/// All materials of the document, in its order, and the textures that they refer to.
struct ReadMaterials {
  std::vector<ReadMaterial> materials;
  std::vector<Texture> textures;
};

ReadMaterials ConvertMaterials(const Asset& asset, size_t max_image_pixels, Notes& notes);

/// glTF's material where a primitive names none: white.
Material DefaultMaterial();

}  // namespace fenestra::gltf
