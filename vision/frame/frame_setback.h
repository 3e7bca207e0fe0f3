#pragma once

#include <optional>
#include <span>

#include "vision/frame/edge_points.h"

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

/// Looks for the reveal, between the wall's edge and the frame. A frame at depth d behind the
/// rectangle shows, on a side that the camera at distance z looks at from h further inwards,
///
///     t = h d / (z + d)
///
/// of it, within the rectangle, and fills the opening there: so all sides and views with an edge
/// to something darker at some t, before the frame's own opening begins, must agree on d. Where
/// they do, that is the setback, right to a pixel or so; where none has such an edge although a
/// reveal 5 cm deep would show it, the frame is flush: mean 0, sigma 0. nullopt where reveals are
/// too narrow to see, or do not agree.
std::optional<Setback> FindSetback(std::span<const CameraView> views, const FrameRectangle& frame,
                                   const RevealGrey& grey);

}  // namespace fenestra
