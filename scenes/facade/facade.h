#pragma once

#include "scenes/facade/facade_options.h"
#include "scenes/scene.h"

namespace fenestra {

/// The target's centroid is (0, 0, -setback_m), whatever else there is. Meshes are named after what
/// they are; where there are such things, in this order: wall, frame, room, sill, lintel, other
/// frame, other room, pane, other panes, shutters, drainpipe, cables, railing, blind, other blinds,
/// plant. Throws InputError, with all faults, if the options are not valid.
Scene MakeFacade(const FacadeOptions& options);

}  // namespace fenestra
