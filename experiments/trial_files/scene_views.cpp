#include "experiments/trial_files/scene_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/io/faults.h"
#include "core/io/image_io.h"
#include "core/io/input_error.h"
#include "core/io/srgb.h"
#include "core/io/temporary_files.h"
#include "experiments/trial_files/truth_files.h"
#include "renderers/ray_caster.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

// However many triangles there are, the bake takes no more than about fifteen seconds.
constexpr size_t kLightPoints = 60000;

// Of all that is written about a pixel, in memory; and of the time for it on one core, where every
// pixel has an edge, without lamps and for each lamp.
constexpr double kBytesPerPixel = 250.0;
constexpr double kSecondsPerPixel = 30e-6;
constexpr double kSecondsPerLampAndPixel = 3e-6;
// Of the light of one lamp on both sides of a triangle.
constexpr double kSecondsPerLampAndTriangle = 4e-6;

Pose LookingAt(const Vector3d& p_WC, const Vector3d& p_WQ) {
  const Vector3d forward = (p_WQ - p_WC).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitY()).normalized();
  Eigen::Matrix3d R_WC;
  R_WC << right, forward.cross(right), forward;
  return Pose(R_WC, p_WC);
}

// The corners of the box around all triangles.
std::pair<Vector3d, Vector3d> Bounds(const Scene& scene) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = -low;
  for (const Mesh& mesh : scene.meshes) {
    for (const glm::uvec3& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        const glm::vec3& p = mesh.positions_W[t[k]];
        low = low.cwiseMin(Vector3d(p.x, p.y, p.z));
        high = high.cwiseMax(Vector3d(p.x, p.y, p.z));
      }
    }
  }
  if (!(low.x() <= high.x())) return {-Vector3d::Ones(), Vector3d::Ones()};
  return {low, high};
}

SceneCamera FrontView(const Scene& scene, const SceneViewOptions& options) {
  // As wide as the stereo camera with its 4 mm lens.
  const CameraModel model =
      CameraModel::Pinhole(options.width_px, options.height_px, 0.9 * options.width_px);
  if (scene.target) {
    const TargetWindow& target = *scene.target;
    const double distance_m = 3.0 * std::max(target.width_m, target.height_m);
    const Vector3d p_WC = target.X_WO * Vector3d(0.0, 0.0, distance_m);
    return {.name = "front", .X_WC = LookingAt(p_WC, target.Centroid_W()), .model = model};
  }
  const auto [low, high] = Bounds(scene);
  const Vector3d centre = 0.5 * (low + high);
  const double radius_m = std::max(0.5 * (high - low).norm(), 1e-3);
  const double half_view = std::atan(0.5 * options.height_px / (0.9 * options.width_px));
  const Vector3d p_WC =
      centre + radius_m / std::sin(half_view) * Vector3d(0.5, 0.4, 1.0).normalized();
  return {.name = "front", .X_WC = LookingAt(p_WC, centre), .model = model};
}

// The value that all but 1 % of the pixels stay below.
float WhitePoint(const cv::Mat& radiance) {
  std::vector<float> values(
      radiance.ptr<float>(),
      radiance.ptr<float>() + radiance.total() * static_cast<size_t>(radiance.channels()));
  const auto at =
      values.begin() + static_cast<ptrdiff_t>(0.99 * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at > 0.0f ? *at : 1.0f;
}

cv::Mat Picture(const cv::Mat& radiance) {
  const float white = WhitePoint(radiance);
  std::vector<cv::Mat1f> planes(static_cast<size_t>(radiance.channels()));
  cv::split(radiance, planes);
  std::vector<cv::Mat1b> encoded;
  for (const cv::Mat1f& plane : planes) encoded.push_back(EncodeSrgb(plane / white));
  cv::Mat picture;
  cv::merge(encoded, picture);
  return picture;
}

void WriteView(const OutputPath& folder, const RayCaster& caster, const SceneCamera& camera,
               const Lighting& lighting, const Vector3d& p_FW) {
  const RayGrid rays(camera.model);
  const auto render = [&](Band band) -> cv::Mat {
    return caster.Render(rays, camera.X_WC, lighting, {.band = band}, RandomStream(0));
  };
  const cv::Mat color = render(Band::kRgb);
  const cv::Mat infrared = render(Band::kInfrared);
  const AovImages aovs = caster.CastAovs(rays, camera.X_WC, lighting, {});
  std::vector<ExrChannel> channels = AovChannels(aovs, "point");
  for (const auto& part :
       {RadianceChannels(color, Band::kRgb), RadianceChannels(infrared, Band::kInfrared)}) {
    channels.insert(channels.end(), part.begin(), part.end());
  }
  const std::array<PlacedCamera, 1> cameras = {PlacedCamera{camera.model, camera.X_WC}};
  WritePng(folder / "color.png", Picture(color));
  WritePng(folder / "infrared.png", Picture(infrared));
  std::map<std::string, std::string> metadata = CameraMetadata(camera.model, camera.X_WC);
  metadata["world_origin_in_file"] = fmt::format("{} {} {} m", p_FW.x(), p_FW.y(), p_FW.z());
  WriteExr(folder / "scene.exr", channels, metadata);
  WriteFileAtomically(
      folder / "truth.json",
      TruthJson(MakeGroundTruth(caster.scene(), camera.X_WC, cameras), "camera", p_FW));
}

// Names become folders, and may come from a file that someone else wrote.
std::string FolderName(const std::string& name, std::set<std::string>& used) {
  std::string folder;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    folder += plain ? c : '_';
  }
  if (folder.empty()) folder = "camera";
  std::string unique = folder.substr(0, 100);
  for (int i = 2; !used.insert(unique).second; ++i) {
    unique = fmt::format("{}_{}", folder.substr(0, 100), i);
  }
  return unique;
}

}  // namespace

GltfScene TrialScene(const TrialSettings& settings) {
  GltfScene world{.scene = MakeScene(settings), .cameras = {}, .sun = {}, .notes = {}};
  const Pose X_WB = RigPoseOf(settings, world.scene);
  const StereoCalibration stereo = DesignOf(settings.stereo);
  const Pose X_BL = Pose::Translation({-0.5 * settings.stereo.baseline_m, 0.0, 0.0});
  const Pose X_BR = X_BL * stereo.X_RL.inverse();
  const StructuredLightSensor sensor(settings.rgbd);
  const RgbdCalibration& rgbd = sensor.nominal();
  world.cameras = {{.name = "left", .X_WC = X_WB * X_BL, .model = stereo.left},
                   {.name = "right", .X_WC = X_WB * X_BR, .model = stereo.right},
                   {.name = "depth", .X_WC = sensor.X_WD(X_WB), .model = rgbd.depth},
                   {.name = "color", .X_WC = sensor.X_WK(X_WB), .model = rgbd.color}};
  if (settings.lighting.sun.illuminance_lx > 0.0) world.sun = settings.lighting.sun;
  return world;
}

std::vector<SceneCamera> CamerasOf(const GltfScene& world, const SceneViewOptions& options) {
  if (!options.camera) {
    if (!world.cameras.empty()) return world.cameras;
    return {FrontView(world.scene, options)};
  }
  std::vector<std::string> names;
  for (const SceneCamera& camera : world.cameras) {
    if (camera.name == *options.camera) return {camera};
    names.push_back(camera.name);
  }
  throw InputError("--camera", fmt::format("the scene has no camera '{}'.{}", *options.camera,
                                           DidYouMean(*options.camera, names)));
}

namespace {

// The work that does not depend on the surfaces alone, whose cost the reader limits.
void CheckCost(const Scene& scene, const std::vector<SceneCamera>& cameras,
               const SceneViewOptions& options) {
  double pixels = 0.0;
  double largest = 0.0;
  for (const SceneCamera& camera : cameras) {
    const double own = 1.0 * camera.model.width_px() * camera.model.height_px();
    pixels += own;
    largest = std::max(largest, own);
  }
  double triangles = 0.0;
  for (const Mesh& mesh : scene.meshes) triangles += static_cast<double>(mesh.triangles.size());
  const auto lamps = static_cast<double>(scene.lamps.size());
  const double seconds = pixels * (kSecondsPerPixel + lamps * kSecondsPerLampAndPixel) +
                         lamps * triangles * kSecondsPerLampAndTriangle;
  const double bytes = largest * kBytesPerPixel;
  const std::string views =
      fmt::format("{} view{} of {:.3g} megapixels in all under {} lamps", cameras.size(),
                  cameras.size() == 1 ? "" : "s", pixels / 1e6, scene.lamps.size());
  Faults faults("render");
  faults.Require(seconds <= options.most_seconds,
                 fmt::format("{} would take about {:.2g} s, more than {:.0f} s (--seconds)", views,
                             seconds, options.most_seconds));
  faults.Require(bytes <= options.most_bytes,
                 fmt::format("{} would need about {:.2g} GB, more than {:.2g} GB (--memory-gb)",
                             views, bytes / 1e9, options.most_bytes / 1e9));
  faults.ThrowIfAny();
}

}  // namespace

void WriteSceneViews(const OutputPath& folder, const GltfScene& world,
                     const SceneViewOptions& options) {
  const std::vector<SceneCamera> cameras = CamerasOf(world, options);
  CheckCost(world.scene, cameras, options);
  const RayCaster caster(world.scene, {.most_light_points = kLightPoints});
  std::set<std::string> used;
  for (const SceneCamera& camera : cameras) {
    WriteView(folder / FolderName(camera.name, used), caster, camera, options.lighting, world.p_FW);
  }
}

}  // namespace fenestra
