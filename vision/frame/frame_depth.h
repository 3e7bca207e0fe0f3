#pragma once

#include <span>

#include "vision/frame/frame_fit.h"
#include "vision/frame/frame_setback.h"

namespace fenestra {

/// Panes, and the frame's edges around them, stand in its thickness.
inline constexpr ReliefPrior kPanes{.mean_m = -0.03, .sigma_m = 0.03};

/// For a frame fitted with a relief of its inner sides: where these are farther behind the outer
/// ones than a frame is thick, 7 cm, the outer ones are the wall's, and the frame moves back,
/// as its reveal tells, or else to its inner ones. Down to 11 cm it may be a thick flush frame as
/// well: then it stays, and the covariance allows for 5 cm.
void StandBack(std::span<const CameraView> views, const RevealGrey& grey, FrameFit& fit);

/// For a frame whose inner sides do not tell its depth: moves it back as its reveal tells
/// (frame_setback.h). Where nothing tells, its covariance allows for 7 cm along the normal, and
/// across it for the parallax of sides that are partly the wall's and partly the frame's.
void SettleDepth(std::span<const CameraView> views, const RevealGrey& grey, FrameFit& fit);

}  // namespace fenestra
