#pragma once

#include <array>

#include "core/random/random_stream.h"
#include "scenes/facade/facade_plan.h"
#include "scenes/scene.h"

namespace fenestra {

// What stands in and before the openings of a facade, without its plants. Each mesh gets the
// material with the index `material`.

/// Distance from an opening's side to the outer edge of the shutter that stands open beside it.
double ShutterReach_m(double window_width_m);

/// The boxes of a window's two open leaves, a little before the wall.
std::array<Box, 2> ShutterLeaves(const FacadeOptions& options, const WindowPlan& window);

/// The leaves of all windows: solid boards, or a rim with slats.
Mesh MakeShutters(const FacadeOptions& options, const FacadePlan& plan, uint32_t material);

/// A blind before or behind a window, let down from the top by `coverage` (see BlindOptions). It
/// hangs in the opening or before it, 5 mm from the reveal on either side.
void AddBlind(const FacadeOptions& options, const WindowPlan& window, double coverage, Mesh& mesh);

/// A round pipe before the wall, from its lower to its upper edge.
Mesh MakeDrainpipe(const FacadeOptions& options, uint32_t material);

/// Cables from edge to edge of the wall, each with a sag of its own. A cable whose sag is small
/// beside its span hangs in a parabola, y = y0 + 4 s (x / w)², with the sag s over the span w.
Mesh MakeCables(const FacadeOptions& options, const RandomStream& random, uint32_t material);

/// Upright bars between a lower and a hand rail before the window, a little wider than it.
Mesh MakeRailing(const FacadeOptions& options, const WindowPlan& window, uint32_t material);

/// Panes of glass in the frame's depth: one in its middle, or two 16 mm apart. They end in the
/// frame, so that no light passes at their edges.
void AddPanes(const WindowOptions& options, const WindowPlan& window, Mesh& mesh);

}  // namespace fenestra
