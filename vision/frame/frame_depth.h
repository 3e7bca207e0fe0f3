#pragma once

#include <span>

#include "vision/frame/frame_fit.h"
#include "vision/frame/frame_setback.h"

namespace fenestra {

/// Panes, and the frame's edges around them, stand in its thickness.
inline constexpr ReliefPrior kPanes{.mean_m = -0.03, .sigma_m = 0.03};

/// How far upright and level sides of a rectangle may be before a frame's front.
struct SideDepths {
  double upright_m;
  double level_m;
};

/// Adds to the covariance of a frame's centroid what comes of sides that may be the frame's own or
/// the wall's before it: those that a camera amid the views looks at from within, since on others
/// the wall's edge hides the frame's.
void AddParallax(std::span<const CameraView> views, const SideDepths& depths, FrameFit& fit);

/// How far the front of a fitted frame is behind its rectangle, whose sides may be the frame's own,
/// the wall's, or one of each. Edges along the upright sides tell, by their parallax between two
/// views (parallax_edges.h, front_belief.h): those of the rectangle itself, of reveals and shadows,
/// and of the opening. Moves the frame there, with what the covariance then lacks: along the
/// normal, and across it for the parallax of sides that are partly the wall's and partly the
/// frame's.
///
/// A frame that is flush, more likely than not, stays where it is; that it may be none is in the
/// covariance. Where there are no such edges, a frame whose upright sides are in one plane and
/// which shows no reveal is flush (frame_setback.h). Where nothing tells, the covariance allows for
/// 7 cm.
void SettleDepth(std::span<const CameraView> views, const RevealGrey& grey, FrameFit& fit);

}  // namespace fenestra
