#include "renderers/tracing/mip_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fenestra {
namespace {

TEST(MipMap, WrapsAsTheTextureSays) {
  Texture texture{.name = "pair", .width_px = 2, .height_px = 1, .texels = {}};
  texture.texels = {{0, 0, 0, 255}, {255, 255, 255, 255}};
  texture.interpolated = false;
  const auto at = [&](Texture::Wrap wrap, float u) {
    texture.wrap_u = wrap;
    return MipMap(texture).Sample({u, 0.5f}, 1.0f).r;
  };
  for (const float u : {-1.9f, -0.9f, 0.1f, 1.1f, 1e6f + 0.125f}) {
    EXPECT_EQ(at(Texture::Wrap::kRepeat, u), 0.0f) << u;
    EXPECT_EQ(at(Texture::Wrap::kClampToEdge, u), u < 0.5f ? 0.0f : 1.0f) << u;
  }
  EXPECT_EQ(at(Texture::Wrap::kMirroredRepeat, 1.1f), 1.0f);
  EXPECT_EQ(at(Texture::Wrap::kMirroredRepeat, 1.9f), 0.0f);
  EXPECT_EQ(at(Texture::Wrap::kMirroredRepeat, -0.1f), 0.0f);
}

}  // namespace
}  // namespace fenestra
