#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>

#include "vision/frame/measurement/side_request.h"

namespace fenestra {

struct BorderSearch {
  double smallest_m;
  double largest_share;    ///< Share of the frame's shorter side.
  double min_contrast_dn;  ///< Mean over the sides.
};

struct BorderFound {
  double border_m;
  std::array<Brighter, 4> brighter;  ///< Which side of the inner edge is brighter, for each side.
  double contrast_dn;                ///< Mean over the sides.
};

/// Mean grey value along a side of the inner rectangle; nullopt if too little of it is in the
/// image.
std::optional<double> MeanAlong(const CameraView& view, const FrameRectangle& frame, Side side);

/// Finds where the frame ends and the opening begins: the inset at which the grey values, averaged
/// along each side and over the views, change most in total over the four sides. The result is
/// accurate to a pixel. Returns nullopt if the grey values hardly change, as in front of a dark
/// room.
std::optional<BorderFound> FindBorder(std::span<const CameraView> views,
                                      const FrameRectangle& frame, const BorderSearch& search);

/// Measures whether the surroundings of the left or the right side are brighter close by than
/// farther away, as they are beside the opening of a bright frame: 0 up to a ratio of 1.4, 1 from a
/// ratio of 2 on, proportional to the logarithm in between; the mean over the views. (A reveal that
/// faces the sun more directly than its wall is rarely so bright. Above and below a window there
/// are lintels and sills, so these sides are not used.)
double BrightBand(std::span<const CameraView> views, const FrameRectangle& frame, double black_dn);

}  // namespace fenestra
