#include "tests/renderers/test_scenes.h"

namespace fenestra {

Material Grey(float reflectance) {
  return {
      .name = "grey", .reflectance_rgb = glm::vec3(reflectance), .reflectance_830nm = reflectance};
}

Mesh Polygon(const std::vector<glm::vec3>& corners_W, uint32_t material) {
  Mesh mesh{.name = "polygon", .positions_W = corners_W, .triangles = {}, .material = material};
  for (uint32_t i = 1; i + 1 < corners_W.size(); ++i) mesh.triangles.push_back({0, i, i + 1});
  return mesh;
}

Mesh UprightRectangle(float left, float bottom, float right, float top, float z,
                      uint32_t material) {
  return Polygon({{left, bottom, z}, {right, bottom, z}, {right, top, z}, {left, top, z}},
                 material);
}

Pose FacingTheWall(const Eigen::Vector3d& p_WC) {
  const Eigen::Matrix3d R_WC = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return Pose(R_WC, p_WC);
}

Pose LookingAt(const Eigen::Vector3d& p_WC, const Eigen::Vector3d& p_WQ) {
  const Eigen::Vector3d forward = (p_WQ - p_WC).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitY()).normalized();
  Eigen::Matrix3d R_WC;
  R_WC << right, forward.cross(right), forward;
  return Pose(R_WC, p_WC);
}

CameraModel DistortedCamera() {
  return CameraModel({.width_px = 376,
                      .height_px = 240,
                      .fx_px = 333.0,
                      .fy_px = 333.0,
                      .cx_px = 187.5,
                      .cy_px = 119.5,
                      .distortion = {.k1 = -0.10, .k2 = 0.01, .p1 = 1e-4, .p2 = -1e-4}});
}

Lighting OnlySun(double azimuth_rad, double elevation_rad, double illuminance_lx) {
  Lighting lighting;
  lighting.sun = {
      .azimuth_rad = azimuth_rad, .elevation_rad = elevation_rad, .illuminance_lx = illuminance_lx};
  lighting.sky = {.illuminance_lx = 0.0, .ground_reflectance = 0.0};
  return lighting;
}

Lighting OnlySky(double illuminance_lx, double ground_reflectance) {
  Lighting lighting;
  lighting.sky = {.illuminance_lx = illuminance_lx, .ground_reflectance = ground_reflectance};
  return lighting;
}

}  // namespace fenestra
