#pragma once

#include <vector>

#include "vision/frame/side_request.h"

namespace fenestra {

/// A pixel near an edge, and its distance from where the edge is assumed, outwards.
struct StripPixel {
  double s_px;
  double grey_dn;
};

/// The pixels around a place on a side of a frame, some pixels along the edge and across it.
struct EdgeStrip {
  double share;            ///< Of the way along the side.
  Eigen::Vector2d pixel;   ///< Where the edge is assumed.
  Eigen::Vector2d normal;  ///< Unit vector across the edge, out of the frame's centre.
  std::vector<StripPixel> pixels;
};

struct EdgeStrips {
  std::vector<EdgeStrip> strips;
  int places = 0;  ///< Also those that are not wholly in the image.
};

/// Divides a side of the frame, as it is assumed, into strips about 8 px long, at most 40. They end
/// `reach_px` before the side's ends, where other sides begin. If coarse, and there are at least
/// 30, those are cut that are a multiple of three strips apart and alike at both ends.
EdgeStrips CutStrips(const CameraView& view, const FrameRectangle& frame,
                     const SideRequest& request);

}  // namespace fenestra
