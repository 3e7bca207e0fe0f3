#pragma once

#include <vector>

#include "vision/frame/measurement/side_request.h"

namespace fenestra {

/// A pixel near an edge and its outward distance from the assumed edge.
struct StripPixel {
  double s_px;
  double grey_dn;
};

/// The pixels around a place on a side of a frame, within a few pixels along and across the edge.
struct EdgeStrip {
  double share;            ///< Share of the way along the side.
  Eigen::Vector2d pixel;   ///< Where the edge is assumed.
  Eigen::Vector2d normal;  ///< Unit normal of the edge, away from the frame's centre.
  std::vector<StripPixel> pixels;
};

struct EdgeStrips {
  std::vector<EdgeStrip> strips;
  int places = 0;  ///< Number of places, including those that are not wholly in the image.
};

/// Divides a side of the assumed frame into at most 40 strips that are about 8 px long. They stop
/// `reach_px` before the ends of the side, where the neighbouring sides begin. A coarse request for
/// a side with at least 30 strips returns every third one, placed symmetrically about the middle of
/// the side.
EdgeStrips CutStrips(const CameraView& view, const FrameRectangle& frame,
                     const SideRequest& request);

/// The places on a frame's front, from the side inwards, at which a profile across the side is
/// sampled.
struct ProfileGrid {
  double first_m;
  double step_m;
  int count;

  double InsetAt(double index) const { return first_m + index * step_m; }
};

/// Grey values across a side. Each is the mean along the middle part of the side, from 0.15 to 0.85
/// of its length.
struct SideProfile {
  std::vector<double> grey_dn;
  /// Variance of each mean, estimated from the scatter of the values along the side; large where
  /// the profile leaves the image.
  std::vector<double> variance;

  int size() const { return static_cast<int>(grey_dn.size()); }
  double Grey(int i) const { return grey_dn[static_cast<size_t>(i)]; }
  double Variance(int i) const { return variance[static_cast<size_t>(i)]; }
};

SideProfile ProfileAcross(const CameraView& view, const FrameRectangle& frame, Side side,
                          const ProfileGrid& grid);

/// Extent of a pixel across a side, on the frame's front in the middle of the side [m]; 0 if that
/// place is not seen.
double PixelAcross(const CameraView& view, const FrameRectangle& frame, Side side);

}  // namespace fenestra
