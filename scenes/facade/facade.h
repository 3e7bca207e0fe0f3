#pragma once

#include "scenes/facade/facade_options.h"
#include "scenes/scene.h"

namespace fenestra {

/// Makes a facade. The target's centroid is always (0, 0, -setback_m). Meshes are named after what
/// they show and come in this order, if they exist: wall, frame, room, sill, lintel, other
/// frame, other room, pane, other panes, shutters, drainpipe, cables, railing, blind, other blinds,
/// plant. Throws InputError, with all faults, if the options are not valid.
Scene MakeFacade(const FacadeOptions& options);

}  // namespace fenestra
