#pragma once

#include <string>
#include <variant>

#include "core/detection.h"
#include "vision/stereo/frame_adjustment.h"
#include "vision/stereo/frame_border.h"

namespace fenestra {

struct FrameFitSettings {
  double min_contrast_dn;
  double reach_px;          ///< Pixels up to here from an edge are used, unless another is nearer.
  double min_side_support;  ///< Share of an outer side's places with its edge.
  BorderSearch border;
  std::optional<SizePrior> prior;
};

struct FrameFit {
  FrameAdjustment adjustment;
  std::array<std::vector<EdgePoint>, 2> points;
  /// Shares of the places along the sides where the frame's edge was found: by outer side in
  /// the better view, and of all inner sides.
  std::array<double, 4> outer_support = {};
  double inner_support = 0.0;
};

/// From a rectangle that is right to some pixels to the one that fits best: measures the sides in
/// both views and adjusts the rectangle to them, in rounds; looks for the border's inner edge
/// after the first round. Miss: "no_edges", "unsupported_side".
std::variant<FrameFit, Miss> FitFrame(const std::array<CameraView, 2>& views,
                                      const FrameRectangle& start,
                                      const FrameFitSettings& settings);

}  // namespace fenestra
