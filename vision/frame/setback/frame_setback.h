#pragma once

#include <span>

#include "vision/frame/measurement/side_request.h"

namespace fenestra {

/// Estimate of how far a frame is recessed behind a rectangle of dark edges, which may be its own
/// outer edges or those of the wall around it.
struct Setback {
  double mean_m;
  double sigma_m;
};

struct RevealGrey {
  double black_dn;         ///< Grey value without light.
  double min_contrast_dn;  ///< Mean grey values along a side that differ by less count as equal.
};

/// Tells whether the views rule out a reveal, i.e. a recess of the frame behind the rectangle. On a
/// side that a camera at distance z looks at from a place h further inwards, a frame at depth d
/// behind the rectangle shows a strip of the reveal of width
///
///     t = h d / (z + d)
///
/// within the rectangle. Returns true if on some side the strip of a reveal 5 cm deep would be wide
/// enough to be seen, and on no side there is a step to something darker, as from a reveal to the
/// frame. There is no such step either where the rectangle is the frame's own edge.
bool ShowsNoReveal(std::span<const CameraView> views, const FrameRectangle& frame,
                   const RevealGrey& grey);

}  // namespace fenestra
