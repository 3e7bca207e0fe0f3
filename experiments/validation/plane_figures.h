#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "experiments/validation/recorded_planes.h"

namespace fenestra::validation {

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
  Estimated noise_steps;
  std::array<Estimated, 3> along_rows{};
  std::array<Estimated, 3> along_columns{};
};
PlaneFigures Measure(const DepthView& view, const cv::Mat1b& mask, const Eigen::Vector3d& plane,
                     double step);

/// Distance of two depths over z²: that of neighbouring levels of 1/z which occur from 1.5 to 4 m
/// [1/m]. Domain: levels there, of which few are left out.
double StepOfDepths(const DepthView& view);

/// RMS of 1/z around the plane that fits all pixels of a mask, less what blocks of 32 x 32 pixels
/// have around planes of their own [steps]: smooth errors of depth, beside noise.
double SmoothError(const DepthView& view, const cv::Mat1b& mask, double step);

/// Holes at the outlines of something near, in rows of a registered depth image: means over the
/// rows that have both.
struct OutlineHoles {
  int rows = 0;
  Estimated left_px;
  Estimated both_px;
  double near_m = 0.0;         ///< Depth at the outlines.
  double beyond_m = 0.0;       ///< Depth past the holes.
  double half_width_px = 0.0;  ///< Of what is near.
};
OutlineHoles MeasureOutlines(const DepthView& view, cv::Range rows, double nearer_than_m);

}  // namespace fenestra::validation
