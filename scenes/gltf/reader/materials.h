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

/// Alpha at which an alpha-blended surface is cut, since Fenestra's surfaces are not transparent.
inline constexpr double kBlendCutoff = 0.5;

/// glTF's default index of refraction.
inline constexpr double kDefaultIndexOfRefraction = 1.5;

/// A material of the document, as a surface of Fenestra's.
struct ReadMaterial {
  Material material;
  std::optional<TextureUse> texture;  ///< Placement of material.texture on the mesh.
  bool is_invisible = false;          ///< Its alpha is below the cutoff everywhere.
};

/// All materials of the document, in its order, and the textures that they refer to.
struct ReadMaterials {
  std::vector<ReadMaterial> materials;
  std::vector<Texture> textures;
};

ReadMaterials ConvertMaterials(const Asset& asset, size_t max_image_pixels, Notes& notes);

/// glTF's default material, for primitives that name none: white.
Material DefaultMaterial();

}  // namespace fenestra::gltf
