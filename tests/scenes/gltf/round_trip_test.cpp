#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/io/input_error.h"
#include "scenes/facade/facade.h"
#include "scenes/gltf/gltf.h"
#include "scenes/gltf/reader/gltf_reader.h"
#include "scenes/gltf/writer/gltf_writer.h"
#include "scenes/targets/flat_targets.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using Names = std::vector<std::string>;
using testing::TemporaryFolder;

bool Same(const Material& a, const Material& b) {
  return a.name == b.name && a.kind == b.kind && a.reflectance_rgb == b.reflectance_rgb &&
         a.reflectance_830nm == b.reflectance_830nm && a.refractive_index == b.refractive_index &&
         a.emission_rgb == b.emission_rgb && a.emission_830nm == b.emission_830nm &&
         a.texture == b.texture && a.alpha_cutoff == b.alpha_cutoff;
}

bool Same(const Mesh& a, const Mesh& b) {
  return a.name == b.name && a.positions_W == b.positions_W && a.triangles == b.triangles &&
         a.material == b.material && a.closed == b.closed &&
         a.texture_coordinates == b.texture_coordinates && a.colors == b.colors &&
         a.normals_W == b.normals_W;
}

bool Same(const Texture& a, const Texture& b) {
  return a.name == b.name && a.width_px == b.width_px && a.height_px == b.height_px &&
         a.texels == b.texels && a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v &&
         a.interpolated == b.interpolated;
}

bool Same(const Lamp& a, const Lamp& b) {
  const bool same_cone =
      a.cone.has_value() == b.cone.has_value() &&
      (!a.cone || (a.cone->axis_W == b.cone->axis_W && a.cone->inner_rad == b.cone->inner_rad &&
                   a.cone->outer_rad == b.cone->outer_rad));
  return a.name == b.name && a.p_WL == b.p_WL && a.intensity_rgb == b.intensity_rgb &&
         a.irradiance_830_per_lux == b.irradiance_830_per_lux && same_cone;
}

bool Same(const TargetWindow& a, const TargetWindow& b) {
  return a.X_WO == b.X_WO && a.width_m == b.width_m && a.height_m == b.height_m;
}

bool Same(const SceneCamera& a, const SceneCamera& b) {
  return a.name == b.name && a.X_WC == b.X_WC && a.model == b.model;
}

template <typename T>
void Compare(const std::string& name, const std::vector<T>& a, const std::vector<T>& b,
             Names& differences) {
  if (a.size() != b.size()) differences.push_back(name + " count");
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (!Same(a[i], b[i])) differences.push_back(name + " " + std::to_string(i));
  }
}

template <typename T>
std::vector<T> AsList(const std::optional<T>& value) {
  return value ? std::vector<T>{*value} : std::vector<T>{};
}

// All that is not equal to the bit; the sun apart.
Names Differences(const GltfScene& a, const GltfScene& b) {
  Names differences;
  Compare("material", a.scene.materials, b.scene.materials, differences);
  Compare("mesh", a.scene.meshes, b.scene.meshes, differences);
  Compare("texture", a.scene.textures, b.scene.textures, differences);
  Compare("lamp", a.scene.lamps, b.scene.lamps, differences);
  Compare("target", AsList(a.scene.target), AsList(b.scene.target), differences);
  Compare("other window", a.scene.other_windows, b.scene.other_windows, differences);
  Compare("camera", a.cameras, b.cameras, differences);
  return differences;
}

Pose OddPose() {
  return Pose(RotationFromVector({0.3, -1.1, 0.7}), {0.1, -2.0 / 3.0, 1e-3});
}

Texture OddTexture() {
  Texture texture{.name = "bricks", .width_px = 3, .height_px = 2, .texels = {}};
  for (uint8_t i = 0; i < 6; ++i) {
    texture.texels.emplace_back(40 * i, 255 - 7 * i, i, 51 * i);  // The first is transparent.
  }
  texture.wrap_u = Texture::Wrap::kMirroredRepeat;
  texture.wrap_v = Texture::Wrap::kClampToEdge;
  texture.interpolated = false;
  return texture;
}

// Every field of a scene, with values that single precision and decimals do not take kindly to.
GltfScene OddScene() {
  GltfScene gltf;
  Scene& scene = gltf.scene;
  scene.textures = {OddTexture(), OddTexture()};
  scene.textures[1].wrap_u = Texture::Wrap::kRepeat;
  scene.textures[1].interpolated = true;
  Material paint{.name = "paint",
                 .reflectance_rgb = {0.1f, 1.0f / 3.0f, 1.0f},
                 .reflectance_830nm = 0.7f,
                 .emission_rgb = {1234.567f, 0.1f, 0.0f},
                 .emission_830nm = 0.123f,
                 .texture = 1,
                 .alpha_cutoff = 0.3f};
  Material lamp_glass{.name = "dim", .emission_rgb = {0.1f, 0.2f, 1.0f}, .texture = 0};
  Material pane{
      .name = "pane", .kind = Material::Kind::kGlass, .refractive_index = 1.61f, .texture = {}};
  scene.materials = {paint, lamp_glass, pane};
  Mesh patch{.name = "patch",
             .positions_W = {{0.1f, 1e-20f, 3e8f}, {1, 0, 0}, {0, -1.0f / 3.0f, 0}},
             .triangles = {{0, 1, 2}, {2, 1, 0}},
             .material = 0,
             .closed = true,
             .texture_coordinates = {{-0.3f, 1.7f}, {0, 0}, {1, 1}},
             .colors = {{0.1f, 0.2f, 0.3f}, {1, 1, 1}, {0, 0, 0}},
             .normals_W = {{0.6f, 0.8f, 0.0f}, {0, 0, 1}, {-0.8f, 0, 0.6f}}};
  Mesh bare{.name = "",
            .positions_W = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
            .triangles = {{0, 1, 2}},
            .material = 2,
            .texture_coordinates = {},
            .colors = {},
            .normals_W = {}};
  scene.meshes = {patch, bare};
  Lamp bulb;
  bulb.name = "bulb";
  bulb.p_WL = {0.1, 0.2, -1.0 / 3.0};
  bulb.intensity_rgb = {812.3f, 0.4f, 100.0f};
  Lamp spot = bulb;
  spot.irradiance_830_per_lux = 8.4e-6;
  spot.cone = {.axis_W = Eigen::Vector3d(1.0, -2.0, 0.3).normalized(),
               .inner_rad = 0.1,
               .outer_rad = 0.5 * std::numbers::pi};
  scene.lamps = {bulb, spot};
  scene.target = {.X_WO = OddPose(), .width_m = 1.1, .height_m = 1.0 / 3.0};
  scene.other_windows = {{.X_WO = OddPose().inverse(), .width_m = 2.0, .height_m = 0.7}};
  CameraParameters odd{.width_px = 752,
                       .height_px = 480,
                       .fx_px = 666.6,
                       .fy_px = 667.7,
                       .cx_px = 375.1,
                       .cy_px = 240.0 / 7.0,
                       .distortion = {.k1 = -0.3, .k2 = 0.1, .p1 = 1e-4, .p2 = -2e-5, .k3 = 0.01}};
  gltf.cameras = {{"left", OddPose(), CameraModel(odd)},
                  {"right", OddPose().inverse(), CameraModel::Pinhole(640, 480, 525.0)}};
  gltf.sun = {.azimuth_rad = 0.7, .elevation_rad = 0.5, .illuminance_lx = 80e3};
  return gltf;
}

GltfScene ThroughFile(const GltfScene& scene, const std::string& name) {
  const TemporaryFolder folder;
  WriteGltf(folder / name, scene);
  return ReadGltf(folder / name);
}

class GltfRoundTrip : public ::testing::TestWithParam<const char*> {};

TEST_P(GltfRoundTrip, ThePaperTargetComesBackToTheBit) {
  GltfScene scene;
  scene.scene = MakePaperTarget({.width_m = 1.3});
  const GltfScene back = ThroughFile(scene, GetParam());
  EXPECT_EQ(Differences(scene, back), Names());
  EXPECT_EQ(back.notes, Names());
}

TEST_P(GltfRoundTrip, TheFacadeComesBackToTheBit) {
  GltfScene scene;
  scene.scene = MakeFacade(
      {.window = {.setback_m = 0.12, .frame = {.reflectance = 0.05, .reflectance_830nm = 0.4}}});
  EXPECT_EQ(Differences(scene, ThroughFile(scene, GetParam())), Names());
}

TEST_P(GltfRoundTrip, EveryFieldComesBackToTheBit) {
  const GltfScene scene = OddScene();
  const GltfScene back = ThroughFile(scene, GetParam());
  EXPECT_EQ(Differences(scene, back), Names());
  // Out through sine and cosine and back through the arc tangent: a few roundings of numbers
  // below 1.
  constexpr double kAngleTolerance = 1e-15;
  ASSERT_TRUE(back.sun);
  EXPECT_NEAR(back.sun->azimuth_rad, scene.sun->azimuth_rad, kAngleTolerance);
  EXPECT_NEAR(back.sun->elevation_rad, scene.sun->elevation_rad, kAngleTolerance);
  EXPECT_EQ(back.sun->illuminance_lx, scene.sun->illuminance_lx);
}

// Surfaces come back to the bit; a pose as exactly as doubles are at that distance.
TEST_P(GltfRoundTrip, ASceneThatWasMovedGoesBackToItsPlace) {
  GltfScene scene;
  scene.scene = MakePaperTarget({.width_m = 1.3});
  scene.cameras = {{"left", OddPose(), CameraModel::Pinhole(640, 480, 525.0)}};
  scene.p_FW = scene.scene.target->Centroid_W().array().round();
  scene.p_FW += Eigen::Vector3d(2600000.0, 450.0, -1200000.0);
  const GltfScene back = ThroughFile(scene, GetParam());
  EXPECT_EQ(back.p_FW, scene.p_FW);
  ASSERT_EQ(back.scene.meshes.size(), scene.scene.meshes.size());
  for (size_t i = 0; i < back.scene.meshes.size(); ++i) {
    EXPECT_EQ(back.scene.meshes[i].positions_W, scene.scene.meshes[i].positions_W);
  }
  const Pose X_WC = back.cameras.at(0).X_WC;
  EXPECT_LT((X_WC.translation() - OddPose().translation()).norm(), 1e-8);
  EXPECT_EQ(X_WC.rotation(), OddPose().rotation());
}

TEST_P(GltfRoundTrip, ASecondTripChangesNothing) {
  const TemporaryFolder folder;
  const auto once = folder / (std::string("once") + GetParam());
  const auto twice = folder / (std::string("twice") + GetParam());
  GltfScene scene = OddScene();
  scene.sun.reset();
  WriteGltf(once, scene);
  WriteGltf(twice, ReadGltf(once));
  EXPECT_EQ(testing::ReadFile(once), testing::ReadFile(twice));
}

INSTANTIATE_TEST_SUITE_P(BothContainers, GltfRoundTrip,
                         ::testing::Values("scene.gltf", "scene.glb"));

TEST(GltfRoundTripCheck, OneUnitInTheLastPlaceIsADifference) {
  const GltfScene scene = OddScene();
  GltfScene other = OddScene();
  other.scene.meshes[0].positions_W[1].x = std::nextafter(1.0f, 2.0f);
  other.scene.target->width_m = std::nextafter(1.1, 2.0);
  other.scene.textures[1].texels[3].a ^= 1;
  EXPECT_EQ(Differences(scene, other), (Names{"mesh 0", "texture 1", "target 0"}));
}

TEST(GltfWriter, RefusesOtherExtensionsAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  EXPECT_THROW(WriteGltf(folder / "scene.obj", OddScene()), InputError);
  EXPECT_THROW(WriteGltf(folder / "scene", OddScene()), InputError);
  EXPECT_TRUE(folder.IsEmpty());
}

TEST(GltfWriter, ASceneWithNothingInItCanBeWritten) {
  EXPECT_EQ(Differences(GltfScene(), ThroughFile(GltfScene(), "scene.glb")), Names());
}

TEST(GltfWriter, MeshesWithoutTrianglesAreLeftOut) {
  GltfScene scene = OddScene();
  const GltfScene without = scene;
  Mesh empty = scene.scene.meshes[0];
  empty.triangles.clear();
  scene.scene.meshes.insert(scene.scene.meshes.begin(), empty);
  EXPECT_EQ(Differences(without, ThroughFile(scene, "scene.glb")), Names());
}

}  // namespace
}  // namespace fenestra
