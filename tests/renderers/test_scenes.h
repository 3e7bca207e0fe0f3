#pragma once

#include <vector>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"
#include "scenes/lighting.h"
#include "scenes/scene.h"

namespace fenestra {

/// A Lambert paint, grey and the same in the infra-red.
Material Grey(float reflectance);

/// A convex polygon in the plane through its corners, which wind counter-clockwise as seen from its
/// front.
Mesh Polygon(const std::vector<glm::vec3>& corners_W, uint32_t material);

/// A rectangle parallel to the facade, facing +Z.
Mesh UprightRectangle(float left, float bottom, float right, float top, float z, uint32_t material);

/// A camera at p_WC that looks along -Z with a level horizon.
Pose FacingTheWall(const Eigen::Vector3d& p_WC);

/// A camera at p_WC that looks at p_WQ with a level horizon.
Pose LookingAt(const Eigen::Vector3d& p_WC, const Eigen::Vector3d& p_WQ);

/// The project's stereo camera at half its size, with its distortion.
CameraModel DistortedCamera();

/// No light but this; the sun alone stands over black ground.
Lighting OnlySun(double azimuth_rad, double elevation_rad, double illuminance_lx);
Lighting OnlySky(double illuminance_lx, double ground_reflectance);

}  // namespace fenestra
