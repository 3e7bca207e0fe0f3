#include "renderers/light/hemisphere_view.h"

#include <gtest/gtest.h>

#include "scenes/mesh/solid_bodies.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

constexpr float kNear_m = 0.005f;

// A cube of 2 m on a floor of 20 m, and a mat 1 mm above the floor.
Scene CubeOnAFloor() {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  Mesh cube{.name = "cube"};
  AddCuboid(CuboidOf({{-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0}}), 1, cube);
  const auto floor_at = [](float half, float x, float y) {
    return Polygon(
        {{x - half, y, half}, {x + half, y, half}, {x + half, y, -half}, {x - half, y, -half}}, 0);
  };
  scene.meshes = {cube, floor_at(10.0f, 0.0f, 0.0f), floor_at(0.5f, 4.0f, 0.001f)};
  return scene;
}

// A scene and what casts rays in it.
struct CastScene {
  explicit CastScene(const Scene& scene)
      : traced(scene),
        patches(traced.opaque(), NumberSurfaces(traced.opaque())),
        caster(traced, patches, elements) {}

  TracedScene traced;
  LightPatches patches;
  LightElements elements;
  HemisphereCaster caster;
};

TEST(HemisphereCaster, HidesWhatLiesInABodyOrUnderAMat) {
  const CastScene cast(CubeOnAFloor());
  const auto is_hidden = [&caster = cast.caster](const glm::vec3& p_W) {
    return caster.About({p_W, {0.0f, 1.0f, 0.0f}}, kNear_m).IsHidden();
  };
  EXPECT_TRUE(is_hidden({0.0f, 0.0f, 0.0f}));
  EXPECT_TRUE(is_hidden({0.9f, 0.0f, 0.9f}));
  EXPECT_TRUE(is_hidden({4.2f, 0.0f, 0.1f}));
  EXPECT_FALSE(is_hidden({4.2f, 0.001f, 0.1f}));  // On the mat.
  EXPECT_FALSE(is_hidden({4.7f, 0.0f, 0.0f}));    // Beside it.
  EXPECT_FALSE(is_hidden({0.9f, 2.0f, 0.9f}));    // On the cube.
}

TEST(HemisphereCaster, DoesNotHideTheFootOfAWall) {
  const CastScene cast(CubeOnAFloor());
  for (const float gap_m : {0.1f, 0.01f, 0.001f, 0.0003f}) {
    const BakePoint on_floor{{1.0f + gap_m, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    const BakePoint on_wall{{1.0f, gap_m, 0.0f}, {1.0f, 0.0f, 0.0f}};
    EXPECT_FALSE(cast.caster.About(on_floor, kNear_m).IsHidden()) << gap_m;
    EXPECT_FALSE(cast.caster.About(on_wall, kNear_m).IsHidden()) << gap_m;
  }
}

TEST(HemisphereCaster, SeesHalfAnOpenSkyAtTheFootOfALongWall) {
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = {UprightRectangle(-1e4f, 0.0f, 1e4f, 1e4f, 0.0f, 0)};
  CastScene cast(scene);
  const HemisphereView view = cast.caster.From({{0.0f, 0.0f, 0.01f}, {0, 1, 0}});
  double sky = 0.0;
  for (const SkyPart& part : view.open.sky) sky += static_cast<double>(part.w) / 3.14159265;
  // Half of the hemisphere, to 0.001.
  EXPECT_NEAR(sky, 0.5, 0.001);
  double wall = 0.0;
  for (const FormFactor& factor : view.factors) wall += static_cast<double>(factor.w);
  EXPECT_NEAR(wall, 0.5, 0.001);
}

}  // namespace
}  // namespace fenestra
