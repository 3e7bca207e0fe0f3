#include "experiments/validation/simulated_planes.h"

#include <cmath>

namespace fenestra::validation {
namespace {

constexpr float kReflectanceOfConcrete = 0.4F;

Scene SceneOf(const Eigen::Vector3d& plane) {
  Scene scene;
  Material material;
  material.reflectance_830nm = kReflectanceOfConcrete;
  scene.materials.push_back(material);
  const Eigen::Vector3d foot = plane / plane.squaredNorm();
  const Eigen::Vector3d across = plane.unitOrthogonal();
  const Eigen::Vector3d along = plane.normalized().cross(across);
  constexpr double kHalf_m = 30.0;
  Mesh mesh{.name = "plane", .material = 0};
  for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    const Eigen::Vector3d p = foot + kHalf_m * (x * across + y * along);
    mesh.positions_W.emplace_back(p.x(), p.y(), p.z());
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes.push_back(mesh);
  return scene;
}

}  // namespace

StructuredLightOptions SensorOfRecordings() {
  StructuredLightOptions options;
  options.depth_width_px = 640;
  options.depth_height_px = 480;
  options.depth_focal_px *= 2.0;
  options.driver = DepthDriver::kOpenNi;
  options.depth_model = DepthModel::kMatched;
  return options;
}

DepthView Simulate(const StructuredLightSensor& sensor, const Eigen::Vector3d& plane) {
  Lighting indoors;
  indoors.sky.illuminance_lx = 300.0;
  const RayCaster caster(SceneOf(plane));
  const DepthImage depth = sensor.ObserveDepth(caster, indoors, Pose(), RandomStream(1)).depth;
  const CameraParameters& k = sensor.nominal().depth.parameters();
  DepthView view{cv::Mat1d(), k.fx_px, {k.cx_px, k.cy_px}};
  depth.raw.convertTo(view.z_m, CV_64F, depth.unit_m);
  return view;
}

PlaneComparison Compare(const RecordedPlane& recorded, const std::filesystem::path& recordings,
                        const StructuredLightOptions& options) {
  const DepthView real = ViewOf(recorded, recordings);
  const cv::Mat1b mask = MaskIn(recorded, real);
  const Eigen::Vector3d plane = FitPlane(real, mask);
  const DepthView view = Simulate(StructuredLightSensor(options), plane);
  return {Measure(real, mask, plane, recorded.step),
          Measure(view, MaskIn(recorded, view), plane, kStepOfOpenNi)};
}

SmoothErrors CompareSmoothErrors(const RecordedPlane& recorded,
                                 const std::filesystem::path& recordings, double warp_px,
                                 const StructuredLightOptions& options) {
  constexpr uint64_t kUnits = 4;
  const DepthView real = ViewOf(recorded, recordings);
  const cv::Mat1b mask = MaskIn(recorded, real);
  const Eigen::Vector3d plane = FitPlane(real, mask);
  const StructuredLightSensor design(options);
  double squares = 0.0;
  for (uint64_t unit = 0; unit < kUnits; ++unit) {
    const DepthView view =
        Simulate(design.Unit({.disparity_warp_px = warp_px}, RandomStream(unit)), plane);
    squares += std::pow(SmoothError(view, MaskIn(recorded, view), kStepOfOpenNi), 2);
  }
  return {SmoothError(real, mask, recorded.step), std::sqrt(squares / kUnits)};
}

}  // namespace fenestra::validation
