#pragma once

#include "scenes/facade/facade_plan.h"
#include "scenes/scene.h"

namespace fenestra {

/// Panes of glass in the frame's depth: one in its middle, or two 16 mm apart. They end in the
/// frame, so that no light passes at their edges.
void AddPanes(const WindowOptions& options, const WindowPlan& window, Mesh& mesh);

}  // namespace fenestra
