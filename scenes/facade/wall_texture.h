#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "core/random/random_stream.h"
#include "scenes/facade/facade_options.h"
#include "scenes/scene.h"

namespace fenestra {

/// Largest root mean square contrast: the standard deviation of a texture's reflectance over its
/// mean.
inline constexpr double kMostTextureContrast = 0.4;

/// Largest deviation of a texel from the mean, in standard deviations, so that reflectances stay
/// between 0 and 1.
inline constexpr double kMostDeviation = 2.5;

/// The reason why this wall cannot have its texture, or an empty text. At too high a contrast the
/// lightest places would have to reflect more light than they receive.
std::string TextureObjection(const WallOptions& wall);

/// A wall's texture and the reflectances that belong to it.
struct TexturedWall {
  Texture texture;
  Material material;    ///< Its mean reflectances, texture considered, are those of the wall.
  double side_m = 0.0;  ///< Side of one copy of the texture on the wall.
};

/// A texture of the wall's contrast (greater than 0), in luminance. Its index in the scene is 0.
TexturedWall MakeTexturedWall(const WallOptions& wall, const RandomStream& random);

/// Lays a texture on a mesh whose faces are perpendicular to the axes of W and whose vertices are
/// shared only by faces that look one way. Texture coordinates are metres over side_m: to the right
/// and down on faces that look along z; away from the wall and down, or to the right and away from
/// the wall, on the others. `shift` is the coordinate of the origin of W.
void LayTexture(double side_m, const glm::dvec2& shift, Mesh& mesh);

}  // namespace fenestra
