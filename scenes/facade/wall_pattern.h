#pragma once

#include <opencv2/core.hpp>

#include "core/random/random_stream.h"
#include "scenes/facade/facade_options.h"

namespace fenestra {

/// What a wall's texture is made from. Patterns are square and go on beyond their edges as if they
/// were laid side by side.
struct WallPattern {
  /// Lightness, without a scale; only differences and their ratios mean something.
  cv::Mat1f lightness;
  /// Where the wall's hue gives way to grey (1), as in mortar; empty: nowhere.
  cv::Mat1f grey;
};

inline constexpr int kPatternSide_px = 1024;
inline constexpr double kPatternSide_m = 2.0;

///   plaster   rendered and felted: band-limited noise from 4 mm to 0.5 m, with grain
///   brick     running bond of German normal-format bricks, 240 mm x 71 mm in courses of 83.3 mm
///             (DIN 4172: 12 courses to the metre), head joints 10 mm; every brick has its shade
///   concrete  panels of 1 m x 2 m with formwork joints and tie holes, blotches and pores
///   cladding  upright boards of 125 mm with open joints of 6 mm and grain along them
WallPattern MakeWallPattern(WallFinish finish, const RandomStream& random);

}  // namespace fenestra
