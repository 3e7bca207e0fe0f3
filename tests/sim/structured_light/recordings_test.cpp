// What the structured-light sensor delivers of planes that real sensors have recorded.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/structured_light/structured_light_sensor.h"
#include "tests/sim/structured_light/recorded_planes.h"

namespace fenestra {
namespace {

using testing::DepthView;
using testing::PlaneFigures;
using testing::RecordedPlane;

constexpr double kStepOfOpenNi = 2.92e-3;  // 1/8 px over f b [1/m]: depth's step over z².
constexpr int kLeastPixels = 500;          // Of a bin that is judged.

// A large plane 1/z = p · ray before a camera at the origin that looks along +z.
Scene SceneOf(const Eigen::Vector3d& plane, double reflectance_830nm) {
  Scene scene;
  Material material;
  material.reflectance_830nm = static_cast<float>(reflectance_830nm);
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

StructuredLightOptions OpenNi() {
  StructuredLightOptions options;
  options.depth_width_px = 640;
  options.depth_height_px = 480;
  options.depth_focal_px *= 2.0;
  options.driver = DepthDriver::kOpenNi;
  options.depth_model = DepthModel::kMatched;
  return options;
}

DepthView ViewOf(const StructuredLightSensor& sensor, const RayCaster& caster,
                 const Lighting& lighting) {
  const DepthImage depth = sensor.ObserveDepth(caster, lighting, Pose(), RandomStream(1)).depth;
  const CameraParameters& k = sensor.nominal().depth.parameters();
  DepthView view{cv::Mat1d(), k.fx_px, {k.cx_px, k.cy_px}};
  depth.raw.convertTo(view.z_m, CV_64F, depth.unit_m);
  return view;
}

DepthView Simulated(const StructuredLightOptions& options, const Eigen::Vector3d& plane,
                    double reflectance_830nm) {
  Lighting indoors;
  indoors.sky.illuminance_lx = 300.0;
  return ViewOf(StructuredLightSensor(options), RayCaster(SceneOf(plane, reflectance_830nm)),
                indoors);
}

// Recorded and simulated, alike.
struct Comparison {
  PlaneFigures recorded;
  PlaneFigures simulated;
};

// Reflectance at 830 nm where it matters: floors that are lost with distance. Concrete; assumed.
constexpr double kReflectance = 0.4;

Comparison Compare(const RecordedPlane& recorded,
                   const StructuredLightOptions& options = OpenNi()) {
  const DepthView real = testing::ViewOf(recorded);
  const cv::Mat1b mask = testing::MaskIn(recorded, real);
  const Eigen::Vector3d plane = testing::FitPlane(real, mask);
  const DepthView view = Simulated(options, plane, kReflectance);
  return {testing::Measure(real, mask, plane, recorded.step),
          testing::Measure(view, testing::MaskIn(recorded, view), plane, kStepOfOpenNi)};
}

// Within 0.1 beside what few blocks tell: 2.5 standard errors of their difference, of some 40
// figures.
void ExpectAlike(const testing::Estimated& simulated, const testing::Estimated& recorded) {
  EXPECT_NEAR(simulated.value, recorded.value,
              0.1 + 2.5 * std::hypot(simulated.error, recorded.error));
}

// Nothing of the noise was fitted to a recording: its size and its correlation follow from
// the contrast of speckle (Landau 2015) and the blocks' size.
TEST(RecordingsTest, NoiseOfPlanesAndItsCorrelationAreAsRecorded) {
  int planes = 0;
  for (const RecordedPlane& recorded : testing::RecordedPlanes()) {
    const Comparison c = Compare(recorded);
    if (c.recorded.blocks < 8 || c.simulated.blocks < 8) continue;
    ++planes;
    SCOPED_TRACE(recorded.name);
    EXPECT_NEAR(c.simulated.noise_steps / c.recorded.noise_steps, 1.0, 0.25);
    for (size_t lag = 0; lag < 3; ++lag) {
      ExpectAlike(c.simulated.along_rows[lag], c.recorded.along_rows[lag]);
      ExpectAlike(c.simulated.along_columns[lag], c.recorded.along_columns[lag]);
    }
  }
  EXPECT_GE(planes, 6);
  // The twin: with a quarter of the contrast a wall is too smooth.
  StructuredLightOptions smooth = OpenNi();
  smooth.infrared.speckle_contrast /= 4.0;
  smooth.infrared.speckle_flicker /= 4.0;
  const Comparison c = Compare(testing::RecordedPlanes().front(), smooth);
  EXPECT_LT(c.simulated.noise_steps / c.recorded.noise_steps, 0.75);
}

// The dark noise was fitted to freiburg2's floor alone; the others are predicted.
TEST(RecordingsTest, AsManyPixelsReturnAsRecorded) {
  // A floor at 78° that returns to 3.8 m as no other does: brighter than assumed, perhaps.
  const std::string too_bright = "region_growing_rgb far floor";
  int bins = 0;
  for (const RecordedPlane& recorded : testing::RecordedPlanes()) {
    const Comparison c = Compare(recorded);
    for (const auto& [place, bin] : c.recorded.bins) {
      const auto simulated = c.simulated.bins.find(place);
      if (bin.pixels < kLeastPixels || simulated == c.simulated.bins.end()) continue;
      if (recorded.name == too_bright && place.first >= 3.5) continue;
      ++bins;
      EXPECT_NEAR(100.0 * simulated->second.Share(), 100.0 * bin.Share(), 10.0)
          << recorded.name << " from " << place.first << " m, " << place.second << " deg";
    }
  }
  EXPECT_GE(bins, 40);
  // The twin: Landau's residuals, taken for the noise in the dark, lose the floor.
  StructuredLightOptions noisy = OpenNi();
  noisy.infrared.dark_noise_dn = 10.4;
  for (const RecordedPlane& recorded : testing::RecordedPlanes()) {
    if (recorded.name != "freiburg2 floor") continue;
    const Comparison c = Compare(recorded, noisy);
    EXPECT_LT(c.simulated.bins.at({4.0, 65.0}).Share(), 0.1);
  }
}

// The warp's size and scale were fitted to these planes, by two units at least.
TEST(RecordingsTest, PlanesAreAsWarpedAsRecordedWithinAFactorOfTwo) {
  constexpr int kUnits = 4;
  const StructuredLightSensor design(OpenNi());
  Lighting indoors;
  indoors.sky.illuminance_lx = 300.0;
  double log_ratios = 0.0;
  double log_ratios_without = 0.0;
  int planes = 0;
  for (const RecordedPlane& recorded : testing::RecordedPlanes()) {
    const DepthView real = testing::ViewOf(recorded);
    const cv::Mat1b mask = testing::MaskIn(recorded, real);
    const Eigen::Vector3d plane = testing::FitPlane(real, mask);
    if (testing::Measure(real, mask, plane, recorded.step).blocks < 8) continue;
    const double recorded_steps = testing::SmoothError(real, mask, recorded.step);
    const RayCaster caster(SceneOf(plane, kReflectance));
    const auto simulated_steps = [&](double warp_px) {
      double squares = 0.0;
      for (uint64_t unit = 0; unit < kUnits; ++unit) {
        const DepthView view = ViewOf(
            design.Unit({.disparity_warp_px = warp_px}, RandomStream(unit)), caster, indoors);
        squares +=
            std::pow(testing::SmoothError(view, testing::MaskIn(recorded, view), kStepOfOpenNi), 2);
      }
      return std::sqrt(squares / kUnits);
    };
    const double found = simulated_steps(UnitDeviations::Calibrated().disparity_warp_px);
    RecordProperty(recorded.name, fmt::format("{:.2f} recorded, {:.2f}", recorded_steps, found));
    EXPECT_NEAR(std::log2(found / recorded_steps), 0.0, 1.2) << recorded.name;
    log_ratios += std::log2(found / recorded_steps);
    log_ratios_without += std::log2(std::max(0.01, simulated_steps(0.0)) / recorded_steps);
    ++planes;
  }
  EXPECT_GE(planes, 5);
  EXPECT_NEAR(log_ratios / planes, 0.0, 0.5);
  // The twin: a unit without a warp.
  EXPECT_LT(log_ratios_without / planes, -1.0);
}

}  // namespace
}  // namespace fenestra
