#pragma once

#include <vector>

#include "vision/frame/side_request.h"

namespace fenestra {

/// Places on a frame's front where a profile across a side is read, from the side inwards.
struct ProfileGrid {
  double first_m;
  double step_m;
  int count;

  double InsetAt(double index) const { return first_m + index * step_m; }
};

/// Grey values across a side, each the mean along its middle: 0.15 to 0.85 of the way.
struct SideProfile {
  std::vector<double> grey_dn;
  /// Of the mean, by how much the values along the side differ; large where it is out of the image.
  std::vector<double> variance;

  int size() const { return static_cast<int>(grey_dn.size()); }
  double Grey(int i) const { return grey_dn[static_cast<size_t>(i)]; }
  double Variance(int i) const { return variance[static_cast<size_t>(i)]; }
};

SideProfile ProfileAcross(const CameraView& view, const FrameRectangle& frame, Side side,
                          const ProfileGrid& grid);

/// Of a pixel across a side in its middle, on the frame's front [m]; 0 if it is not seen.
double PixelAcross(const CameraView& view, const FrameRectangle& frame, Side side);

}  // namespace fenestra
