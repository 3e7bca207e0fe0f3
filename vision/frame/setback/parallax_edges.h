#pragma once

#include <vector>

#include "vision/frame/measurement/side_request.h"

namespace fenestra {

/// An edge along a vertical side of a frame, located in space by two views. Insets are measured
/// from the side inwards, in the plane of the frame's front.
struct ParallaxEdge {
  Side side;
  /// Where the first view sees it on the frame's front, from the side inwards.
  double seen_inset_m;
  double inset_m;           ///< Where it is.
  double behind_m;          ///< Distance behind the plane of the front.
  double sigma_m;           ///< Standard deviation of behind_m from noise.
  double crowding_m;        ///< Standard deviation of behind_m from a neighbouring edge; 0: none.
  double rise_dn;           ///< Step of the grey values, inwards.
  bool is_crowded_outside;  ///< Whether the neighbouring edge is on the outer side.
  /// Whether the first camera is farther out than the edge. It then looks across the frame there
  /// rather than at the inside of its surround.
  bool is_looked_across;
};

/// Finds edges along the left or the right side, from a few pixels outside the side to 0.3 of the
/// frame's width inside it. Each edge is matched between the two views by its surroundings. A
/// camera that is h inwards from the side and z in front of the front sees an edge τ inwards and δ
/// behind the front at
///
///     t = (τ z + h δ) / (z + δ)   ⇔   τ + δ (h - t)/z = t,
///
/// which is linear in τ and δ, so two views give two equations. Reports edges whose mean contrast
/// along the side exceeds its noise and that lie within 15 cm in front of and 25 cm behind the
/// front. The views must be displaced along the front, as those of a stereo pair are; otherwise no
/// edges are found.
std::vector<ParallaxEdge> FindParallaxEdges(const CameraView& first, const CameraView& second,
                                            const FrameRectangle& frame, Side side);

}  // namespace fenestra
