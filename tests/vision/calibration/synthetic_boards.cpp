#include "tests/vision/calibration/synthetic_boards.h"

#include <Eigen/Geometry>
#include <cmath>

namespace fenestra::testing {
namespace {

CameraModel Camera(double f_px, double cx_px, double cy_px, double k1) {
  return CameraModel({.width_px = 752,
                      .height_px = 480,
                      .fx_px = f_px,
                      .fy_px = 1.001 * f_px,
                      .cx_px = cx_px,
                      .cy_px = cy_px,
                      .distortion = {.k1 = k1, .k2 = 0.02, .p1 = 2e-4, .p2 = -3e-4}});
}

std::vector<BoardCorner> CornersIn(const CameraModel& camera, const Pose& X_CG,
                                   const CalibrationBoard& board, double noise_px,
                                   const RandomStream& stream) {
  std::vector<BoardCorner> corners;
  for (int id = 0; id < board.corner_count(); ++id) {
    const auto pixel = camera.Project(X_CG * board.Corner(id));
    const auto index = static_cast<uint64_t>(id);
    const Eigen::Vector2d noise(stream.Normal(2 * index), stream.Normal(2 * index + 1));
    if (pixel) corners.push_back({.id = id, .pixel = *pixel + noise_px * noise});
  }
  return corners;
}

}  // namespace

StereoCalibration ExamplePair() {
  return {.left = Camera(664.0, 372.0, 243.0, -0.11),
          .right = Camera(671.0, 380.0, 237.0, -0.09),
          .X_RL = Pose(RotationFromVector({2e-3, -5e-3, 3e-3}), {-0.351, 1e-3, -5e-4})};
}

std::vector<NamedView> SyntheticViews(const StereoCalibration& pair, const CalibrationBoard& board,
                                      int count, double noise_px, const RandomStream& stream,
                                      double largest_tilt_rad) {
  std::vector<NamedView> views;
  for (int i = 0; i < count; ++i) {
    const RandomStream view = stream.Child("view", static_cast<uint64_t>(i));
    const auto between = [&](uint64_t index, double low, double high) {
      return low + (high - low) * view.Uniform(index);
    };
    const double z_m = between(0, 1.1, 1.8);
    const Eigen::Vector3d p_LCentre(0.175 + between(1, -0.12, 0.12), between(2, -0.15, 0.15), z_m);
    const double axis = between(3, 0.0, 2.0 * M_PI);
    const double tilt = between(4, 0.5 * largest_tilt_rad, largest_tilt_rad);
    const Eigen::Matrix3d R_LG =
        RotationFromVector(tilt * Eigen::Vector3d(std::cos(axis), std::sin(axis), 0.0)) *
        RotationFromVector({0.0, 0.0, between(5, -0.2, 0.2)});
    const Eigen::Vector3d p_GCentre(0.5 * board.width_m(), 0.5 * board.height_m(), 0.0);
    const Pose X_LG(R_LG, p_LCentre - R_LG * p_GCentre);
    views.push_back({.name = std::to_string(i),
                     .corners = {CornersIn(pair.left, X_LG, board, noise_px, view.Child("left")),
                                 CornersIn(pair.right, pair.X_RL * X_LG, board, noise_px,
                                           view.Child("right"))}});
  }
  return views;
}

}  // namespace fenestra::testing
