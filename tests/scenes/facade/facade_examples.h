#pragma once

#include "scenes/facade/facade.h"

namespace fenestra {

/// A street facade: three rows of three windows with everything that a window has around it and
/// nothing before its frame. Without texture, which takes the most time.
inline FacadeOptions StreetFacade() {
  FacadeOptions o;
  o.window.setback_m = 0.1;
  o.window.vertical_mullions = 1;
  o.window.horizontal_mullions = 2;
  o.grid = {.windows_left = 1,
            .windows_right = 1,
            .windows_above = 1,
            .windows_below = 1,
            .gap_x_m = 1.3};
  o.sill.present = true;
  o.lintel.present = true;
  o.lintel.projection_m = 0.02;
  o.shutters.present = true;
  o.drainpipe.present = true;
  o.drainpipe.x_m = 1.15;
  return o;
}

/// The same with all that hangs or grows before the window.
inline FacadeOptions CoveredFacade() {
  FacadeOptions o = StreetFacade();
  o.cables.count = 3;
  o.railing.present = true;
  o.blind.coverage = 0.4;
  o.plant.coverage = 0.3;
  return o;
}

}  // namespace fenestra
