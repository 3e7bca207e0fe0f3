#include "experiments/trial_files/scene_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/io/image_io.h"
#include "core/io/input_error.h"
#include "renderers/exr_io.h"
#include "scenes/gltf/reader/gltf_reader.h"
#include "scenes/gltf/writer/gltf_writer.h"
#include "scenes/targets/flat_targets.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using testing::ReadFile;
using testing::TemporaryFolder;

SceneViewOptions Small() {
  SceneViewOptions options{.width_px = 96, .height_px = 64};
  options.lighting.sun.illuminance_lx = 0.0;
  options.lighting.sky.illuminance_lx = 1e4;
  return options;
}

GltfScene World(std::vector<SceneCamera> cameras = {}) {
  return {.scene = MakePaperTarget({}), .cameras = std::move(cameras), .sun = {}, .notes = {}};
}

// Looks at the target from straight in front.
SceneCamera Before(const std::string& name, double distance_m) {
  const Eigen::Matrix3d facing = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return {.name = name,
          .X_WC = Pose(facing, {0.0, 0.0, distance_m}),
          .model = CameraModel::Pinhole(96, 64, 80.0)};
}

TEST(SceneViews, ASceneWithoutCamerasIsSeenFromBeforeItsTarget) {
  const GltfScene world = World();
  const std::vector<SceneCamera> cameras = CamerasOf(world, Small());
  ASSERT_EQ(cameras.size(), 1u);
  const SceneCamera& camera = cameras.front();
  EXPECT_EQ(camera.model.width_px(), 96);
  // Three times the larger side away, the target in the image's middle, upright.
  EXPECT_NEAR((camera.X_WC.translation() - world.scene.target->Centroid_W()).norm(), 3.0, 1e-12);
  for (const Eigen::Vector3d& corner_W : world.scene.target->Corners_W()) {
    const auto pixel = camera.model.Project(camera.X_WC.inverse() * corner_W);
    ASSERT_TRUE(pixel && camera.model.Contains(*pixel));
  }
  const auto middle =
      camera.model.Project(camera.X_WC.inverse() * world.scene.target->Centroid_W());
  EXPECT_NEAR(middle->x(), 47.5, 1e-9);
  EXPECT_NEAR(middle->y(), 31.5, 1e-9);
  EXPECT_NEAR(camera.X_WC.rotation()(1, 0), 0.0, 1e-12) << "the horizon is not level";
}

TEST(SceneViews, WithoutATargetAllOfTheSceneIsSeen) {
  GltfScene world = World();
  world.scene.target.reset();
  const SceneCamera camera = CamerasOf(world, Small()).front();
  for (const Mesh& mesh : world.scene.meshes) {
    for (const glm::vec3& p : mesh.positions_W) {
      const auto pixel =
          camera.model.Project(camera.X_WC.inverse() * Eigen::Vector3d(p.x, p.y, p.z));
      ASSERT_TRUE(pixel.has_value());
      EXPECT_TRUE(camera.model.Contains(*pixel)) << pixel->transpose();
    }
  }
}

TEST(SceneViews, AnEmptySceneHasAViewAllTheSame) {
  GltfScene world;
  const SceneCamera camera = CamerasOf(world, Small()).front();
  EXPECT_TRUE(camera.X_WC.translation().allFinite());
}

TEST(SceneViews, CamerasAreChosenByName) {
  const GltfScene world = World({Before("left", 2.0), Before("right", 3.0)});
  EXPECT_EQ(CamerasOf(world, Small()).size(), 2u);
  SceneViewOptions options = Small();
  options.camera = "right";
  const auto chosen = CamerasOf(world, options);
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen.front().X_WC.translation().z(), 3.0);
  options.camera = "rihgt";
  try {
    CamerasOf(world, options);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("Did you mean 'right'?"));
  }
}

TEST(SceneViews, FilesHoldPicturesRadianceAndTruth) {
  const TemporaryFolder folder;
  WriteSceneViews(folder.path(), World({Before("left", 2.0)}), Small());
  const std::filesystem::path view = folder / "left";
  const cv::Mat3b color = ReadColorImage(view / "color.png");
  EXPECT_EQ(color.size(), cv::Size(96, 64));
  EXPECT_EQ(ReadGrayImage(view / "infrared.png").size(), cv::Size(96, 64));
  // Exposed such that a hundredth of the pixels is white: of an evenly lit wall most are.
  double brightest = 0.0;
  cv::minMaxLoc(color.reshape(1), nullptr, &brightest);
  EXPECT_EQ(brightest, 255.0);
  const ExrImage exr = ReadExr(view / "scene.exr");
  const auto channel = [&](const std::string& name) -> const ExrChannel& {
    const auto found = std::find_if(exr.channels.begin(), exr.channels.end(),
                                    [&](const ExrChannel& c) { return c.name == name; });
    EXPECT_NE(found, exr.channels.end()) << name;
    return *found;
  };
  // The wall is 2 m away along the optical axis everywhere, and reflects 0.8 of a half sky and the
  // ground.
  const cv::Mat1f depth = channel("depth.Z").values;
  EXPECT_NEAR(depth(10, 10), 2.0f, 1e-5f);
  EXPECT_GT(cv::Mat1f(channel("G").values)(10, 10), 0.0f);
  const auto truth = nlohmann::json::parse(ReadFile(view / "truth.json"));
  EXPECT_TRUE(truth["target_in_view"].get<bool>());
  EXPECT_NEAR(truth["target"]["centroid_m"][2].get<double>(), 2.0, 1e-12);
}

// A root node that carries everything to the coordinates of a map.
std::filesystem::path CarriedAway(const std::filesystem::path& scene, const TemporaryFolder& folder,
                                  const Eigen::Vector3d& p_FW, double turned_rad) {
  auto document = nlohmann::json::parse(ReadFile(scene));
  const size_t root = document["nodes"].size();
  document["nodes"].push_back(
      {{"translation", {p_FW.x(), p_FW.y(), p_FW.z()}},
       {"rotation", {0.0, std::sin(0.5 * turned_rad), 0.0, std::cos(0.5 * turned_rad)}},
       {"children", document["scenes"][0]["nodes"]}});
  document["scenes"][0]["nodes"] = {root};
  return folder.Write("far.gltf", document.dump());
}

TEST(SceneViews, CoordinatesOfAMapChangeNeitherPictureNorTruth) {
  const TemporaryFolder folder;
  const std::filesystem::path near = folder / "near.gltf";
  WriteGltf(near, World({Before("left", 2.0)}));
  WriteSceneViews(folder / "near", ReadGltf(near), Small());
  const Eigen::Vector3d p_FW(500000.0, 0.0, -4649776.0);
  const GltfScene far = ReadGltf(CarriedAway(near, folder, p_FW, 0.25 * std::numbers::pi));
  WriteSceneViews(folder / "far", far, Small());
  for (const char* picture : {"left/color.png", "left/infrared.png"}) {
    const cv::Mat a = cv::imread(folder / "near" / picture, cv::IMREAD_UNCHANGED);
    const cv::Mat b = cv::imread(folder / "far" / picture, cv::IMREAD_UNCHANGED);
    EXPECT_LE(cv::norm(a, b, cv::NORM_INF), 1.0) << picture;
  }
  const auto truth = [&folder](const char* name) {
    return nlohmann::json::parse(ReadFile(folder / name / "left/truth.json"));
  };
  for (int corner = 0; corner < 4; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto of = [&](const char* name) {
        return truth(name)["target"]["corners_m"][corner][axis].get<double>();
      };
      EXPECT_NEAR(of("near"), of("far"), 1e-8);
    }
  }
  EXPECT_NEAR(truth("far")["world_origin_in_file_m"][2].get<double>(), p_FW.z(), 2.0);
  EXPECT_EQ(truth("near")["world_origin_in_file_m"][2].get<double>(), 0.0);
}

// Before anything is rendered: this would take a day.
TEST(SceneViews, WhatIsTooMuchIsRefusedWithWhatItWouldNeed) {
  const TemporaryFolder folder;
  GltfScene world = World(std::vector<SceneCamera>(1000, Before("left", 2.0)));
  world.scene.lamps.resize(10'000);
  try {
    WriteSceneViews(folder.path(), world, Small());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("1000 views of 6.14 megapixels in all under 10000 lamps"));
    EXPECT_THAT(error.what(), HasSubstr("more than 120 s"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// Names may come from a file that someone else wrote.
TEST(SceneViews, NamesOfCamerasMakeNoPaths) {
  const TemporaryFolder folder;
  WriteSceneViews(folder.path(),
                  World({Before("../../etc/passwd", 2.0), Before("", 2.0), Before("", 2.5),
                         Before(std::string(300, 'x'), 2.0)}),
                  Small());
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.push_back(entry.path().filename());
  }
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("______etc_passwd", "camera", "camera_2",
                                                     std::string(100, 'x')));
}

}  // namespace
}  // namespace fenestra
