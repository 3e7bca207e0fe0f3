#pragma once

#include <array>

#include "scenes/facade/facade_plan.h"
#include "scenes/scene.h"

namespace fenestra {

/// From an opening's side to the outer edge of the shutter that stands open beside it.
double ShutterReach_m(double window_width_m);

/// The boxes of a window's two open leaves, a little before the wall.
std::array<Box, 2> ShutterLeaves(const FacadeOptions& options, const WindowPlan& window);

/// The leaves of all windows: solid boards, or a rim with slats.
Mesh MakeShutters(const FacadeOptions& options, const FacadePlan& plan, uint32_t material);

}  // namespace fenestra
