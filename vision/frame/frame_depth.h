#pragma once

#include <span>

#include "vision/frame/frame_fit.h"

namespace fenestra {

/// Panes, and the frame's edges around them, stand in its thickness.
inline constexpr ReliefPrior kPanes{.mean_m = -0.03, .sigma_m = 0.03};

/// For a frame fitted with a relief of its inner sides: where these are farther behind the outer
/// ones than a frame is thick, 8.5 cm, the outer ones are the wall's, and the frame moves back,
/// as its reveal tells, or else to its inner ones.
void StandBack(std::span<const CameraView> views, double black_dn, FrameFit& fit);

/// For a frame whose inner sides do not tell its depth: moves it back as its reveal tells
/// (frame_setback.h). Where nothing tells, its covariance allows for 7 cm along the normal, and
/// across it for the parallax of sides that are partly the wall's and partly the frame's.
void SettleDepth(std::span<const CameraView> views, double black_dn, FrameFit& fit);

}  // namespace fenestra
