#pragma once

#include <vector>

#include "vision/frame/side_request.h"

namespace fenestra {

/// An edge along an upright side of a frame, placed in space by two views.
struct ParallaxEdge {
  Side side;
  double
      seen_inset_m;   ///< Where the first view sees it on the frame's front, from the side inwards.
  double inset_m;     ///< Where it is.
  double behind_m;    ///< Behind the plane of the front.
  double sigma_m;     ///< Of behind_m, by noise.
  double crowding_m;  ///< The same by another edge that is near; 0: none is.
  double rise_dn;     ///< Of the grey values, inwards.
  bool is_crowded_outside;  ///< Whether such a one is outwards.
  /// Whether the first camera stands farther out than the edge is, and so looks across the frame
  /// there, not at the inside of what surrounds it.
  bool is_looked_across;
};

/// Edges along the left or the right side, from a few pixels outside of it inwards to 0.3 of the
/// frame's width, each found in both views by its surroundings. With h and z the camera's place
/// inwards from the side and before the front, an edge τ inwards and δ behind the front is seen at
///
///     t = (τ z + h δ) / (z + δ)   ⇔   τ + δ (h - t)/z = t,
///
/// which is linear in τ and δ: two views, two equations. Edges are told whose mean contrast along
/// the side exceeds its noise, at places within 15 cm before and 25 cm behind the front. For two
/// views that are apart along the front, as those of a stereo pair; none otherwise.
std::vector<ParallaxEdge> FindParallaxEdges(const CameraView& first, const CameraView& second,
                                            const FrameRectangle& frame, Side side);

}  // namespace fenestra
