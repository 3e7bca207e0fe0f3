#pragma once

#include "scenes/facade/facade_plan.h"
#include "scenes/scene.h"

namespace fenestra {

/// A blind before or behind a window, let down from the top by `coverage` (see BlindOptions). It
/// hangs in the opening or before it, 5 mm from the reveal on either side.
void AddBlind(const FacadeOptions& options, const WindowPlan& window, double coverage, Mesh& mesh);

}  // namespace fenestra
