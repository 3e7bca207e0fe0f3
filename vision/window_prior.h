#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/detection.h"
#include "core/observation.h"
#include "core/parameter_table.h"

namespace fenestra {

/// What form a window is known to have.
enum class ExpectedShape {
  kAny,              ///< Nothing is known: any quadrilateral that the detector takes for a frame.
  kRectangle,        ///< Its corners are right angles.
  kUprightRectangle  ///< Its sides also stand upright in the image: neither is rolled.
};

/// What may be known of a window before it is looked for. By default nothing is, and a detector
/// finds any dark-framed quadrilateral. A prior makes a detector refuse what does not match it;
/// some detectors also measure better with it, and say so.
struct WindowPrior {
  // Size of the frame's outer rectangle; 0: not known.
  double expected_width_m = 0.0;
  double expected_height_m = 0.0;
  /// What a carpenter's tape, or a drawing, is worth.
  double expected_size_sigma_m = 0.02;

  // Shape.
  /// Width over height; 0: not known. For windows of which many sizes of one form are made.
  double expected_aspect = 0.0;
  /// Relative. Detectors measure sides to some per cent.
  double expected_aspect_tolerance = 0.15;
  ExpectedShape expected_shape = ExpectedShape::kAny;
  /// 15°: a corner that is known to some pixels of a side of 40 px.
  double expected_angle_tolerance_rad = 0.2617993877991494;

  // The frame's colour, 8-bit sRGB, for detectors that see colours; -1: not known.
  int expected_red_dn = -1;
  int expected_green_dn = -1;
  int expected_blue_dn = -1;
  /// In each channel: as wide as the paper's "below 50" is for black.
  int expected_color_tolerance_dn = 50;

  /// The frame's grey value over that of the wall beside it, both above the black level, for
  /// detectors that see grey values only; 0: not known. A ratio, since light is not known.
  double expected_grey_ratio = 0.0;
  /// Absolute. Blur mixes frame and wall where the frame is a few pixels wide.
  double expected_grey_tolerance = 0.15;

  bool knows_size() const { return expected_width_m > 0.0; }
  bool knows_color() const { return expected_red_dn >= 0; }
  bool knows_grey() const { return expected_grey_ratio > 0.0; }

  bool operator==(const WindowPrior&) const = default;
};

/// The options that say what is known, under one name in all detectors, all beginning with
/// "expected_"; colour for RGB-D sensors, grey values for stereo ones. To be adopted by the table
/// of a detector:
///
///     table.Adopt<WindowPrior>(PriorParameters(SensorKind::kStereo), FENESTRA_FIELD(prior));
ParameterTable<WindowPrior> PriorParameters(SensorKind sensor);

/// Whether an option of this name says what is known beforehand.
bool IsPriorOption(const std::string& name);

/// What is contradictory or half-said. Ranges are the parameters' own matter.
std::vector<std::string> FaultsOf(const WindowPrior& prior);

/// "unexpected_size" or "unexpected_shape" for a window that is not the expected one.
/// `side_share`: how far a side as measured may be from its true length, as a share of the shorter
/// side. Sizes may depart by that, or by five of the prior's standard deviations.
std::optional<Miss> ObjectionOf(const WindowPrior& prior, const WindowEstimate& estimate,
                                double side_share);

/// "unexpected_grey" for a frame whose grey value over its wall's is not the expected one.
std::optional<Miss> ObjectionOf(const WindowPrior& prior, double grey_ratio);

/// 255 where a pixel has the expected colour. Domain: knows_color.
cv::Mat1b ExpectedColor(const WindowPrior& prior, const cv::Mat3b& image);

}  // namespace fenestra
