#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace fenestra::validation {

/// A part of a recorded depth image that sees one plane, by a polygon drawn by hand [px].
struct RecordedPlane {
  std::string name;
  std::string file;    ///< In the folder of recordings, such as tests/data.
  std::string source;  ///< With its licence.
  double unit_m;
  double focal_px;
  Eigen::Vector2d centre_px;
  double step;  ///< Distance of two depths over z² [1/m].
  std::vector<cv::Point> polygon;
};

/// Walls, a screen and floors, by Kinects with OpenNI's driver.
const std::vector<RecordedPlane>& RecordedPlanes();

/// A depth image as depths [m], 0 without return, with the pinhole that took it.
struct DepthView {
  cv::Mat1d z_m;
  double focal_px;
  Eigen::Vector2d centre_px;

  Eigen::Vector3d RayOf(int u, int v) const {
    return {(u - centre_px.x()) / focal_px, (v - centre_px.y()) / focal_px, 1.0};
  }
};
/// Throws InputError if the file cannot be read.
DepthView ViewOf(const RecordedPlane& recorded, const std::filesystem::path& recordings);

/// The recorded polygon in a view of another focal length.
cv::Mat1b MaskIn(const RecordedPlane& recorded, const DepthView& view);

}  // namespace fenestra::validation
