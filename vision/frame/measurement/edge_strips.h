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

}  // namespace fenestra
