#include "scenes/facade/wall_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/io/input_error.h"
#include "scenes/facade/facade.h"
#include "scenes/facade/wall_pattern.h"
#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

double Linear(uint8_t srgb) {
  const double s = srgb / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

double Luminance(double r, double g, double b) {
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

struct Statistics {
  double mean = 0.0;
  double contrast = 0.0;
  double mean_830nm = 0.0;
};

// Of the wall's reflectance: texture times material, as scene.h says.
Statistics Measure(const TexturedWall& wall) {
  std::vector<double> linear(256);
  for (size_t i = 0; i < 256; ++i) linear[i] = Linear(static_cast<uint8_t>(i));
  const glm::dvec3 rgb = wall.material.reflectance_rgb;
  double sum = 0.0;
  double squares = 0.0;
  double sum_830nm = 0.0;
  for (const glm::u8vec4& texel : wall.texture.texels) {
    const double r = linear[texel.r];
    const double g = linear[texel.g];
    const double b = linear[texel.b];
    const double visible = Luminance(rgb.r * r, rgb.g * g, rgb.b * b);
    sum += visible;
    squares += visible * visible;
    sum_830nm += static_cast<double>(wall.material.reflectance_830nm) * Luminance(r, g, b);
  }
  const auto n = static_cast<double>(wall.texture.texels.size());
  return {sum / n, std::sqrt(squares / n - sum / n * sum / n) / (sum / n), sum_830nm / n};
}

WallOptions Wall(WallFinish finish, double contrast, Hue hue = Hue::kNeutral) {
  WallOptions wall;
  wall.finish = finish;
  wall.texture_contrast = contrast;
  wall.paint = {.reflectance = 0.25, .reflectance_830nm = 0.3, .hue = hue};
  return wall;
}

class WallTextures : public ::testing::TestWithParam<WallFinish> {};
INSTANTIATE_TEST_SUITE_P(OfAllKinds, WallTextures,
                         ::testing::Values(WallFinish::kPlaster, WallFinish::kBrick,
                                           WallFinish::kConcrete, WallFinish::kCladding),
                         [](const auto& finish) {
                           return WallFinishNames()[static_cast<size_t>(finish.param)];
                         });

TEST_P(WallTextures, HaveTheGivenMeansAndContrast) {
  for (const auto& [contrast, hue] :
       {std::pair{0.03, Hue::kNeutral}, std::pair{0.25, Hue::kNeutral},
        std::pair{0.2, Hue::kBrickRed}}) {
    const Statistics found =
        Measure(MakeTexturedWall(Wall(GetParam(), contrast, hue), RandomStream(3)));
    EXPECT_NEAR(found.mean, 0.25, 0.01 * 0.25) << contrast;
    EXPECT_NEAR(found.mean_830nm, 0.3, 0.01 * 0.3) << contrast;
    EXPECT_NEAR(found.contrast, contrast, 0.05 * contrast) << contrast;
  }
}

TEST_P(WallTextures, GoOnBeyondTheirEdges) {
  const Texture t = MakeTexturedWall(Wall(GetParam(), 0.2), RandomStream(4)).texture;
  const auto at = [&t](int v, int u) {
    return static_cast<double>(
        t.texels[static_cast<size_t>(v % t.height_px) * static_cast<size_t>(t.width_px) +
                 static_cast<size_t>(u % t.width_px)]
            .g);
  };
  // Mean square step from one column or row to the next; joints make some of the inner ones large.
  const auto step = [&](bool across_columns, int from) {
    double sum = 0.0;
    for (int i = 0; i < t.width_px; ++i) {
      const double difference =
          across_columns ? at(i, from + 1) - at(i, from) : at(from + 1, i) - at(from, i);
      sum += difference * difference;
    }
    return sum / t.width_px;
  };
  for (const bool across_columns : {true, false}) {
    double largest = 0.0;
    for (int i = 0; i + 1 < t.width_px; ++i) largest = std::max(largest, step(across_columns, i));
    EXPECT_LE(step(across_columns, t.width_px - 1), 1.05 * largest) << across_columns;
  }
  // The twin: half the texture does not go on. Brick and cladding repeat more often than that.
  if (GetParam() != WallFinish::kPlaster) return;
  double inner = 0.0;
  for (int i = 0; i + 1 < t.width_px; ++i) inner = std::max(inner, step(true, i));
  double cut = 0.0;
  for (int v = 0; v < t.height_px; ++v) cut += std::pow(at(v, 0) - at(v, t.width_px / 2), 2);
  EXPECT_GT(cut / t.height_px, 1.05 * inner);
}

TEST_P(WallTextures, AreFunctionsOfTheSeed) {
  const auto make = [](uint64_t seed) {
    return MakeTexturedWall(Wall(GetParam(), 0.2), RandomStream(seed)).texture.texels;
  };
  EXPECT_EQ(make(1), make(1));
  EXPECT_NE(make(1), make(2));
}

TEST(WallTexture, WithoutContrastIsNone) {
  EXPECT_TRUE(MakeFacade({}).textures.empty());
  FacadeOptions o;
  o.wall.texture_contrast = 0.05;
  const Scene scene = MakeFacade(o);
  EXPECT_NO_THROW(Validate(scene));
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials[0].texture, 0u);
}

// A wall of 0.8 at a contrast of 0.2 has places that would reflect 1.2.
TEST(WallTexture, MustNotReflectMoreLightThanThereIs) {
  FacadeOptions o;
  o.wall.texture_contrast = 0.2;
  EXPECT_THROW(MakeFacade(o), InputError);
  o.wall.paint = {.reflectance = 0.6, .reflectance_830nm = 0.8};
  EXPECT_THROW(MakeFacade(o), InputError);
  o.wall.paint = {.reflectance = 0.6, .reflectance_830nm = 0.6};
  EXPECT_NO_THROW(MakeFacade(o));
}

// The strictest case that is allowed still has reflectances up to 1 and keeps its means.
TEST_P(WallTextures, KeepTheirMeansUpToTheBrightestAllowed) {
  WallOptions wall = Wall(GetParam(), 0.2, Hue::kBrickRed);
  while (TextureObjection(wall).empty()) wall.paint.reflectance += 0.01;
  wall.paint.reflectance -= 0.01;
  while (TextureObjection(wall).empty()) wall.paint.reflectance_830nm += 0.01;
  wall.paint.reflectance_830nm -= 0.01;
  const Statistics found = Measure(MakeTexturedWall(wall, RandomStream(3)));
  EXPECT_NEAR(found.mean, wall.paint.reflectance, 0.01 * wall.paint.reflectance);
  EXPECT_NEAR(found.mean_830nm, wall.paint.reflectance_830nm, 0.01 * wall.paint.reflectance_830nm);
}

TEST(WallTexture, IsLaidInMetresOnWallAndReveal) {
  FacadeOptions o;
  o.wall.texture_contrast = 0.05;
  o.wall.texture_scale = 0.5;
  const Scene scene = MakeFacade(o);
  const Mesh& wall = *Find(scene, "wall");
  ASSERT_EQ(wall.texture_coordinates.size(), wall.positions_W.size());
  const double side_m = 0.5 * kPatternSide_m;
  for (const glm::uvec3& t : wall.triangles) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = t[k];
      const uint32_t b = t[(k + 1) % 3];
      const glm::dvec3 step = glm::dvec3(wall.positions_W[b]) - glm::dvec3(wall.positions_W[a]);
      const glm::dvec2 uv =
          glm::dvec2(wall.texture_coordinates[b]) - glm::dvec2(wall.texture_coordinates[a]);
      // Coordinates of up to 8 in single precision.
      EXPECT_NEAR(std::hypot(uv.x, uv.y) * side_m, std::hypot(step.x, step.y, step.z), 1e-5);
    }
  }
}

}  // namespace
}  // namespace fenestra
