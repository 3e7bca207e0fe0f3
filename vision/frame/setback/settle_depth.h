#pragma once

#include <span>

#include "vision/frame/adjustment/frame_fit.h"
#include "vision/frame/setback/frame_setback.h"

namespace fenestra {

/// Prior for panes and for the frame's edges around them, which lie within its thickness.
inline constexpr ReliefPrior kPanes{.mean_m = -0.03, .sigma_m = 0.03};

/// How far the vertical and the horizontal sides of a rectangle may be in front of a frame's front.
struct SideDepths {
  double upright_m;
  double level_m;
};

/// Adds to the covariance of a frame's centroid the error of sides that may be the frame's own edge
/// or the edge of the wall in front of it. Only sides that a camera amid the views looks at from
/// within are concerned; on the others, the wall's edge hides the frame's. A camera at distance z
/// that looks at a side from h further inwards sees an edge d in front of the frame displaced by h
/// d / (z + d) on the frame's front; the centroid is off by half of it.
void AddParallax(std::span<const CameraView> views, const SideDepths& depths, FrameFit& fit);

/// Estimates how far the front of a fitted frame is behind its rectangle, whose sides may be the
/// frame's own, the wall's, or one of each, and moves the frame there. The evidence is the parallax
/// between two views (parallax_edges.h, frame_setback.h) of edges along the vertical sides: those
/// of the rectangle itself, of reveals and shadows, and of the opening. The uncertainty is added to
/// the covariance along the normal, and across it for the parallax of sides that are partly the
/// wall's and partly the frame's.
///
/// A frame that is probably flush stays where it is; the covariance allows for the case that it is
/// not. If there are no such edges, a frame whose vertical sides lie in one plane and that shows no
/// reveal is taken to be flush (frame_setback.h). Without any evidence, as always with a single
/// view, the covariance allows for a setback of 7 cm, since windows are recessed by up to 10 cm.
void SettleDepth(std::span<const CameraView> views, const RevealGrey& grey, FrameFit& fit);

}  // namespace fenestra
