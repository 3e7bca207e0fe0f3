#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace fenestra {

/// A picture on a surface. Red, green and blue are sRGB-encoded; alpha is linear.
struct Texture {
  /// What stands beyond [0, 1] of a texture coordinate.
  enum class Wrap { kRepeat, kMirroredRepeat, kClampToEdge };

  std::string name{};
  int width_px = 0;
  int height_px = 0;
  std::vector<glm::u8vec4> texels{};  ///< Row-major from the top left; width_px · height_px.
  Wrap wrap_u = Wrap::kRepeat;
  Wrap wrap_v = Wrap::kRepeat;
  /// Between texel centres, linear interpolation of linear values; else the nearest texel.
  bool interpolated = true;
};

}  // namespace fenestra
