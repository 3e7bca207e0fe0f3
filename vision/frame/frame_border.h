#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>

#include "vision/frame/side_request.h"

namespace fenestra {

struct BorderSearch {
  double smallest_m;
  double largest_share;    ///< Of the frame's shorter side.
  double min_contrast_dn;  ///< Mean over the sides.
};

struct BorderFound {
  double border_m;
  std::array<Brighter, 4> brighter;  ///< By side.
  double contrast_dn;                ///< Mean over the sides.
};

/// Mean grey value along a side of the inner rectangle; nullopt where too little is in the image.
std::optional<double> MeanAlong(const CameraView& view, const FrameRectangle& frame, Side side);

/// Where the frame ends and the opening begins: the inset at which the grey values, averaged along
/// each side and over the views, change most, as summed over the four sides. nullopt where they
/// hardly change, as in front of a dark room. Right to a pixel.
std::optional<BorderFound> FindBorder(std::span<const CameraView> views,
                                      const FrameRectangle& frame, const BorderSearch& search);

/// Whether the surroundings of the left or the right side are brighter nearby than farther away, as
/// beside the opening of a bright frame: 0 up to 1.4 times, 1 from 2 times on, in proportion to the
/// logarithm in between; mean of the views. (A reveal that faces the sun more than its wall does is
/// rarely so bright; above and below there are lintels and sills.)
double BrightBand(std::span<const CameraView> views, const FrameRectangle& frame, double black_dn);

}  // namespace fenestra
