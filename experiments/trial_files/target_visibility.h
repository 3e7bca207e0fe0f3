#pragma once

#include "sim/truth/ground_truth.h"

namespace fenestra {

/// Share of a window's frame that the scored camera sees, in [0, 1]: of points in equal steps along
/// the middle of the frame's front border, those that fall into the image and before which nothing
/// stands. The depth is that of the pixel's centre where the border covers it; points on borders
/// that are too narrow for that are left out, and without any other point the share is 0.
double VisibleShare(const TruthImages& images, const WindowTruth& window, double border_m);

}  // namespace fenestra
