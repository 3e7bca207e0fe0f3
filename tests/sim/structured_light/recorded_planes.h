#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

namespace fenestra::testing {

/// A part of a recorded depth image that sees one plane, by a polygon drawn by hand [px].
struct RecordedPlane {
  std::string name;
  std::string file;  ///< In tests/data.
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
DepthView ViewOf(const RecordedPlane& recorded);

/// p: 1/z = p · ray. By random samples of three pixels and least squares.
Eigen::Vector3d FitPlane(const DepthView& view, const cv::Mat1b& mask);

/// A figure with its standard error.
struct Estimated {
  double value = 0.0;
  double error = 0.0;
};

/// What can be said of a plane's depth. Noise [steps]: RMS in blocks of 32 x 32 pixels around a
/// plane of their own, the median over blocks; autocorrelation of its residuals at lags of 1 to 3
/// pixels. Bins: 0.5 m of depth times 5° of incidence, by the plane.
struct PlaneFigures {
  struct Bin {
    int pixels = 0;
    int valid = 0;
    double Share() const { return static_cast<double>(valid) / pixels; }
  };
  std::map<std::pair<double, double>, Bin> bins;  ///< By least z [m] and least incidence [deg].
  int blocks = 0;
  double noise_steps = 0.0;
  std::array<Estimated, 3> along_rows{};
  std::array<Estimated, 3> along_columns{};
};
PlaneFigures Measure(const DepthView& view, const cv::Mat1b& mask, const Eigen::Vector3d& plane,
                     double step);

/// RMS of 1/z around the plane that fits all pixels of a mask, less what blocks of 32 x 32 pixels
/// have around planes of their own [steps]: smooth errors of depth, beside noise.
double SmoothError(const DepthView& view, const cv::Mat1b& mask, double step);

/// The recorded polygon in a view of another focal length.
cv::Mat1b MaskIn(const RecordedPlane& recorded, const DepthView& view);

}  // namespace fenestra::testing
