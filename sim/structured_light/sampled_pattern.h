#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace fenestra {

/// The projector's pattern as pixels of the infra-red camera gather it: dots with a Gaussian
/// spread, averaged over the pixel, relative to a dot that is centred on its pixel.
class SampledPattern {
 public:
  /// dot_sigma_px: the spread [cells].
  explicit SampledPattern(double dot_sigma_px);

  /// A pixel that is centred on this place of the pattern [cells]. Rows of pixels are rows of
  /// cells: camera and projector are rectified.
  float At(double column, int row) const;

  /// Of the pattern that is displaced by this along its rows [cells], over pixels at whole cells.
  /// Dots that fall between two pixels stand out less: the variance depends on the displacement.
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
  /// A tile, as pixels at whole cells gather the pattern that is displaced by this [cells].
  cv::Mat1f Displaced(double displacement) const;

  std::array<float, 2 * (kReach + 1) * kStepsPerCell + 2> spread_{};
  /// Dots gathered along the columns; each row is continued by the tile's beginning.
  cv::Mat1f gathered_;
};

}  // namespace fenestra
