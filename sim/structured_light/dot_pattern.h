#pragma once

#include <array>
#include <bitset>

namespace fenestra {

/// The pattern of dots that a structured-light projector casts: a tile of cells, each with a dot or
/// without, repeated in both directions. One cell is one pixel wide in the infra-red image that the
/// sensor matches.
///
/// Figures: 211 x 165 cells a tile, 3861 dots (11.1 %), as measured on the Kinect's pattern
/// (A. Reichinger's reconstruction, in M. J. Landau's KinectSimulator), whose windows of 9 x 9 hold
/// 6 to 12 dots. The arrangement is our own: dots that keep their distance from each other, so that
/// windows hold 5 to 13, and any two windows of a row within 105 cells differ in 4 cells or more.
class DotPattern {
 public:
  static constexpr int kTileWidth = 211;
  static constexpr int kTileHeight = 165;
  static constexpr int kDots = 3861;

  /// Always the same pattern: it is a property of the product, like its lenses.
  DotPattern();

  /// Whether there is a dot in a cell; any integers.
  bool HasDot(int column, int row) const { return dots_[Index(column, row)]; }

 private:
  static size_t Index(int column, int row);
  std::bitset<static_cast<size_t>(kTileWidth) * kTileHeight> dots_;
};

}  // namespace fenestra
