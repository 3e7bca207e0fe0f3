#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/detection/detection.h"
#include "core/detection/observation.h"
#include "core/io/parameter_table.h"

namespace fenestra {

/// The shape that a window is known to have.
enum class ExpectedShape {
  kAny,              ///< Nothing is known: any quadrilateral that the detector takes for a frame.
  kRectangle,        ///< Its corners are right angles.
  kUprightRectangle  ///< In addition, its sides are not rolled in the image.
};

/// Prior knowledge of a window. By default there is none, and a detector finds any dark-framed
/// quadrilateral. With a prior, a detector refuses windows that do not match it; some detectors
/// also measure better with it, as their options say.
struct WindowPrior {
  // Size of the frame's outer rectangle; 0: not known.
  double expected_width_m = 0.0;
  double expected_height_m = 0.0;
  /// The accuracy of a tape measure or a drawing.
  double expected_size_sigma_m = 0.02;

  // Shape.
  /// Width over height; 0: not known. Useful for windows that are made in many sizes of one shape.
  double expected_aspect = 0.0;
  /// Relative tolerance. Detectors measure sides to a few per cent.
  double expected_aspect_tolerance = 0.15;
  ExpectedShape expected_shape = ExpectedShape::kAny;
  /// 15°: the accuracy of an angle between sides of 40 px whose corners are known to some pixels.
  double expected_angle_tolerance_rad = 0.2617993877991494;

  // The frame's colour, 8-bit sRGB, for detectors that see colours; -1: not known.
  int expected_red_dn = -1;
  int expected_green_dn = -1;
  int expected_blue_dn = -1;
  /// Tolerance of each channel, as wide as the paper's "below 50" is for black.
  int expected_color_tolerance_dn = 50;

  /// Ratio of the frame's grey value to that of the wall beside it, both above the black level, for
  /// detectors that see only grey values; 0: not known. It is a ratio because the light is not
  /// known.
  double expected_grey_ratio = 0.0;
  /// Absolute tolerance. Blur mixes frame and wall if the frame is only a few pixels wide.
  double expected_grey_tolerance = 0.15;

  bool knows_size() const { return expected_width_m > 0.0; }
  bool knows_color() const { return expected_red_dn >= 0; }
  bool knows_grey() const { return expected_grey_ratio > 0.0; }

  bool operator==(const WindowPrior&) const = default;
};

/// Parameters of the prior. Their names begin with "expected_" and are the same for all detectors;
/// colours are for RGB-D sensors, grey values for stereo ones. A detector's table adopts them by
///
///     table.Adopt<WindowPrior>(PriorParameters(SensorKind::kStereo), FENESTRA_FIELD(prior));
ParameterTable<WindowPrior> PriorParameters(SensorKind sensor);

/// Tells whether an option of this name belongs to the prior.
bool IsPriorOption(const std::string& name);

/// Returns contradictory or incomplete options. Ranges are checked by the parameter table.
std::vector<std::string> FaultsOf(const WindowPrior& prior);

/// Returns "unexpected_size" or "unexpected_shape" for a window that does not match the prior.
/// `side_share` is the largest error of a measured side as a share of the shorter side. Sizes may
/// differ by that, or by five of the prior's standard deviations if that is more.
std::optional<Miss> ObjectionOf(const WindowPrior& prior, const WindowEstimate& estimate,
                                double side_share);

/// Returns "unexpected_grey" for a frame whose grey ratio to its wall does not match the prior.
std::optional<Miss> ObjectionOf(const WindowPrior& prior, double grey_ratio);

/// Returns 255 where a pixel has the expected colour. Domain: knows_color().
cv::Mat1b ExpectedColor(const WindowPrior& prior, const cv::Mat3b& image);

}  // namespace fenestra
