#pragma once

#include <filesystem>

#include "experiments/validation/plane_figures.h"
#include "experiments/validation/recorded_planes.h"
#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra::validation {

/// Distance of two depths over z² that a sensor with OpenNI's driver is built for, 1/8 px over f b
/// [1/m].
inline constexpr double kStepOfOpenNi = 2.92e-3;

/// The sensor as the recordings have it: 640 x 480, OpenNI's driver, dots that are matched.
StructuredLightOptions SensorOfRecordings();

/// Depth of the plane 1/z = plane · ray before a camera at the origin that looks along +z, indoors
/// at 300 lx, of concrete: it reflects 0.4 at 830 nm (assumed), which matters where floors are lost
/// with distance.
DepthView Simulate(const StructuredLightSensor& sensor, const Eigen::Vector3d& plane);

/// The plane that a recording shows, as recorded and as the simulated sensor sees it.
struct PlaneComparison {
  PlaneFigures recorded;
  PlaneFigures simulated;
};
PlaneComparison Compare(const RecordedPlane& recorded, const std::filesystem::path& recordings,
                        const StructuredLightOptions& options = SensorOfRecordings());

/// SmoothError of both [steps]; of the simulated sensor the RMS over units with a warp of this
/// standard deviation [px].
struct SmoothErrors {
  double recorded;
  double simulated;
};
SmoothErrors CompareSmoothErrors(const RecordedPlane& recorded,
                                 const std::filesystem::path& recordings, double warp_px,
                                 const StructuredLightOptions& options = SensorOfRecordings());

}  // namespace fenestra::validation
