#pragma once

#include <span>

#include "vision/frame/side_request.h"

namespace fenestra {

/// How far a frame stands back from a rectangle of dark edges that may be its own outer edge or the
/// edge of the wall around it.
struct Setback {
  double mean_m;
  double sigma_m;
};

struct RevealGrey {
  double black_dn;         ///< Grey value without light.
  double min_contrast_dn;  ///< Of mean grey values along a side: what differs by less is alike.
};

/// A frame at depth d behind the rectangle shows, on a side that the camera at distance z looks at
/// from h further inwards,
///
///     t = h d / (z + d)
///
/// of the reveal between them, within the rectangle. Whether that is wide enough somewhere to be
/// seen of a reveal 5 cm deep, and nowhere there is a step to something darker, as from a reveal to
/// the frame. Where the rectangle is a frame's own edge there is none either.
bool ShowsNoReveal(std::span<const CameraView> views, const FrameRectangle& frame,
                   const RevealGrey& grey);

}  // namespace fenestra
