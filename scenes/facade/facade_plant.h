#pragma once

#include "core/random/random_stream.h"
#include "scenes/facade/facade_plan.h"
#include "scenes/scene.h"

namespace fenestra {

/// Leaves in clusters before a window's frame. Clusters begin at random places of the frame that
/// are still visible. Leaves are added until the share `coverage` of the frame's front is covered,
/// as seen along the wall's normal; the last leaf exceeds it by at most its own size.
Mesh MakePlant(const FacadeOptions& options, const WindowPlan& window, const RandomStream& random,
               uint32_t material);

}  // namespace fenestra
