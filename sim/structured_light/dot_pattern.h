#pragma once

#include <array>
#include <bitset>
#include <opencv2/core.hpp>

namespace fenestra {

/// The pattern of dots that a structured-light projector casts: a tile of cells, each with a dot or
/// without, repeated in both directions. One cell is one pixel wide in the infra-red image that the
/// sensor matches.
///
/// Figures: 211 x 165 cells a tile, 3861 dots (11.1 %), as measured on the Kinect's pattern
/// (A. Reichinger's reconstruction, in M. J. Landau's KinectSimulator), whose blocks of 9 x 9 hold
/// 6 to 12 dots. The arrangement is our own: dots keep a distance from each other, so that blocks
/// hold 5 to 13, and any two blocks of a row within 105 cells differ in 4 cells or more.
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

/// The projector's pattern as the pixels of the infra-red camera sample it: dots with a Gaussian
/// spread, averaged over the pixel, relative to a dot that is centred on its pixel.
class SampledPattern {
 public:
  /// dot_sigma_px: the spread [cells].
  explicit SampledPattern(double dot_sigma_px);

  /// Value of a pixel that is centred on this place of the pattern [cells]. Rows of pixels are rows
  /// of cells, since camera and projector are rectified.
  float At(double column, int row) const;

  /// Moments of the pattern that is displaced along its rows [cells], over pixels at whole cells.
  /// The variance depends on the displacement, since dots between two pixels have less contrast.
  struct Moments {
    double mean;
    double variance;
  };
  Moments MomentsAt(double displacement) const;
  /// Correlation coefficient of the patterns at these displacements.
  double Correlation(double displacement_a, double displacement_b) const;

 private:
  static constexpr int kReach = 2;
  static constexpr int kStepsPerCell = 64;
  float SpreadAt(double offset) const;
  /// A tile of the pattern that is displaced by this [cells], sampled by pixels at whole cells.
  cv::Mat1f Displaced(double displacement) const;

  std::array<float, 2 * (kReach + 1) * kStepsPerCell + 2> spread_{};
  /// Dots gathered along the columns; each row is continued by the tile's beginning.
  cv::Mat1f gathered_;
};

}  // namespace fenestra
