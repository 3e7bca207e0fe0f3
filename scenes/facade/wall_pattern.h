#pragma once

#include <opencv2/core.hpp>

#include "core/random/random_stream.h"
#include "scenes/facade/facade_options.h"

namespace fenestra {

/// The pattern from which a wall's texture is made. Patterns are square and repeat beyond their
/// edges.
struct WallPattern {
  /// Lightness without a scale: only differences and their ratios have a meaning.
  cv::Mat1f lightness;
  /// 1 where the wall's hue gives way to grey, as in mortar; empty: nowhere.
  cv::Mat1f grey;
};

inline constexpr int kPatternSide_px = 1024;
inline constexpr double kPatternSide_m = 2.0;

/// Makes the pattern of a finish:
///
///   plaster   rendered and felted: band-limited noise from 4 mm to 0.5 m, with grain
///   brick     running bond of German normal-format bricks, 240 mm x 71 mm in courses of 83.3 mm
///             (DIN 4172: 12 courses to the metre), head joints 10 mm; every brick has its shade
///   concrete  panels of 1 m x 2 m with formwork joints and tie holes, blotches and pores
///   cladding  upright boards of 125 mm with open joints of 6 mm and grain along them
WallPattern MakeWallPattern(WallFinish finish, const RandomStream& random);

}  // namespace fenestra
