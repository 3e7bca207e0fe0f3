#pragma once

#include "core/random/random_stream.h"
#include "scenes/facade/facade_plan.h"
#include "scenes/scene.h"

namespace fenestra {

/// A round pipe before the wall, from its lower to its upper edge.
Mesh MakeDrainpipe(const FacadeOptions& options, uint32_t material);

/// Cables from edge to edge of the wall, each with a sag of its own. A cable whose sag is small
/// beside its span hangs in a parabola, y = y0 + 4 s (x / w)², with the sag s over the span w.
Mesh MakeCables(const FacadeOptions& options, const RandomStream& random, uint32_t material);

/// Upright bars between a lower and a hand rail before the window, a little wider than it.
Mesh MakeRailing(const FacadeOptions& options, const WindowPlan& window, uint32_t material);

}  // namespace fenestra
