#include "scenes/facade/facade_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/faults.h"
#include "scenes/facade/facade_parts.h"
#include "scenes/facade/facade_plan.h"
#include "scenes/facade/wall_texture.h"

namespace fenestra {
namespace {

void CheckWall(const FacadeOptions& o, Faults& faults) {
  const WallOptions& wall = o.wall;
  faults.RequirePositive("wall_width_m", wall.width_m);
  faults.RequirePositive("wall_height_m", wall.height_m);
  faults.RequirePositive("wall_thickness_m", wall.thickness_m);
  CheckPaint("wall", wall.paint, faults);
  faults.RequirePositive("texture_scale", wall.texture_scale);
  faults.RequireWithin("texture_contrast", wall.texture_contrast, 0.0, kMostTextureContrast);
  if (faults.count() == 0) {
    const std::string objection = TextureObjection(wall);
    faults.Require(objection.empty(), objection);
  }
}

void CheckMullions(const WindowOptions& w, Faults& faults) {
  faults.RequirePositive("mullion_width_m", w.mullion_width_m);
  const auto fits = [&](const char* name, int count, double clear_m) {
    faults.Require(count >= 0, fmt::format("{} must be 0 or more, not {}", name, count));
    faults.Require(count <= 0 || !(count * w.mullion_width_m >= clear_m),
                   fmt::format("{} of {} m each do not fit into {:g} m: {}", name,
                               w.mullion_width_m, clear_m, count));
  };
  fits("vertical_mullions", w.vertical_mullions, w.width_m - 2.0 * w.frame_width_m);
  fits("horizontal_mullions", w.horizontal_mullions, w.height_m - 2.0 * w.frame_width_m);
}

void CheckWindow(const FacadeOptions& o, Faults& faults) {
  const WindowOptions& w = o.window;
  faults.RequirePositive("window_width_m", w.width_m);
  faults.RequirePositive("window_height_m", w.height_m);
  faults.RequirePositive("frame_width_m", w.frame_width_m);
  faults.RequirePositive("frame_depth_m", w.frame_depth_m);
  faults.RequireNotNegative("frame_setback_m", w.setback_m);
  CheckPaint("frame", w.frame, faults);
  const bool frame_fits = !(2.0 * w.frame_width_m >= std::min(w.width_m, w.height_m));
  faults.Require(frame_fits, fmt::format("two sides of a frame of {} m do not fit into {} m x {} m",
                                         w.frame_width_m, w.width_m, w.height_m));
  if (frame_fits) CheckMullions(w, faults);
  faults.Require(
      !(w.setback_m + w.frame_depth_m > o.wall.thickness_m),
      fmt::format("a frame {} m deep, set back by {} m, does not fit into a wall of {} m",
                  w.frame_depth_m, w.setback_m, o.wall.thickness_m));
  faults.Require(!(w.double_glazing && w.glass && w.frame_depth_m <= kPaneGap_m),
                 fmt::format("two panes {} m apart do not fit into a frame {} m deep", kPaneGap_m,
                             w.frame_depth_m));
}

void CheckGrid(const FacadeOptions& o, Faults& faults) {
  const GridOptions& g = o.grid;
  for (const auto& [name, count] :
       {std::pair{"windows_left", g.windows_left}, std::pair{"windows_right", g.windows_right},
        std::pair{"windows_above", g.windows_above}, std::pair{"windows_below", g.windows_below}}) {
    faults.Require(count >= 0, fmt::format("{} must be 0 or more, not {}", name, count));
  }
  faults.Require(g.gap_x_m > kPartition_m,
                 fmt::format("window_gap_x_m must be greater than {}, not "
                             "{}: a partition stands between two rooms",
                             kPartition_m, g.gap_x_m));
  faults.Require(g.gap_y_m > kPartition_m,
                 fmt::format("window_gap_y_m must be greater than {}, not "
                             "{}: a ceiling lies between two rooms",
                             kPartition_m, g.gap_y_m));
  faults.RequireWithin("other_windows_share", g.other_windows_share, 0.0, 1.0);
  CheckPaint("other_frame", g.other_frame, faults);
  const auto fits = [&](const char* along, int before, int after, double window_m, double gap_m,
                        double wall_m) {
    const double half_m =
        0.5 * window_m + std::max(before, after) * (window_m + gap_m) + kMasonry_m;
    faults.Require(!(2.0 * half_m > wall_m),
                   fmt::format("windows of {} m with {} m around them need a wall of {:g} m in {}, "
                               "centred on the target; it has {} m",
                               window_m, kMasonry_m, 2.0 * half_m, along, wall_m));
  };
  fits("width", g.windows_left, g.windows_right, o.window.width_m, g.gap_x_m, o.wall.width_m);
  fits("height", g.windows_above, g.windows_below, o.window.height_m, g.gap_y_m, o.wall.height_m);
}

void CheckRoom(const RoomOptions& room, Faults& faults) {
  faults.RequirePositive("room_depth_m", room.depth_m);
  CheckPaint("room", room.paint, faults);
  faults.RequireNotNegative("room_lamp_lm", room.lamp_lm);
  faults.RequireNotNegative("other_room_lamps_lm", room.other_lamps_lm);
  faults.RequireNotNegative("room lamp_irradiance_830_per_lux", room.lamp_irradiance_830_per_lux);
}

// How much wall each window has to itself on either side: half the gap, or up to the wall's end.
double FreeBeside(const FacadeOptions& o) {
  const GridOptions& g = o.grid;
  const int most = std::max(g.windows_left, g.windows_right);
  const double to_end =
      0.5 * o.wall.width_m - 0.5 * o.window.width_m - most * (o.window.width_m + g.gap_x_m);
  return most > 0 ? std::min(0.5 * g.gap_x_m, to_end) : to_end;
}

double FreeAboveAndBelow(const FacadeOptions& o) {
  const GridOptions& g = o.grid;
  const int most = std::max(g.windows_above, g.windows_below);
  const double to_end =
      0.5 * o.wall.height_m - 0.5 * o.window.height_m - most * (o.window.height_m + g.gap_y_m);
  return most > 0 ? std::min(0.5 * g.gap_y_m, to_end) : to_end;
}

void CheckAroundWindows(const FacadeOptions& o, Faults& faults) {
  const auto fits = [&](const char* what, double needed_m, double free_m) {
    faults.Require(
        !(needed_m > free_m),
        fmt::format("{} needs {:g} m of wall beside each window, of which there is {:g} m", what,
                    needed_m, free_m));
  };
  if (o.sill.present) {
    faults.RequireNotNegative("sill_projection_m", o.sill.projection_m);
    faults.RequireNotNegative("sill_overhang_m", o.sill.overhang_m);
    faults.RequirePositive("sill_thickness_m", o.sill.thickness_m);
    CheckPaint("sill", o.sill.paint, faults);
    fits("the sill", o.sill.overhang_m, FreeBeside(o));
    fits("the sill", o.sill.thickness_m, FreeAboveAndBelow(o));
  }
  if (o.lintel.present) {
    faults.RequirePositive("lintel_height_m", o.lintel.height_m);
    faults.RequireNotNegative("lintel_overhang_m", o.lintel.overhang_m);
    faults.RequireNotNegative("lintel_projection_m", o.lintel.projection_m);
    CheckPaint("lintel", o.lintel.paint, faults);
    fits("the lintel", o.lintel.overhang_m, FreeBeside(o));
    fits("the lintel", o.lintel.height_m, FreeAboveAndBelow(o));
  }
  if (o.shutters.present) {
    CheckPaint("shutter", o.shutters.paint, faults);
    fits("an open shutter", ShutterReach_m(o.window.width_m), FreeBeside(o));
  }
}

void CheckDrainpipe(const FacadeOptions& o, Faults& faults) {
  const DrainpipeOptions& pipe = o.drainpipe;
  if (!pipe.present) return;
  faults.RequirePositive("drainpipe_radius_m", pipe.radius_m);
  faults.RequireNotNegative("drainpipe_clearance_m", pipe.clearance_m);
  CheckPaint("drainpipe", pipe.paint, faults);
  faults.Require(std::abs(pipe.x_m) + pipe.radius_m <= 0.5 * o.wall.width_m,
                 fmt::format("a drainpipe at x = {} m does not stand before a wall of {} m",
                             pipe.x_m, o.wall.width_m));
  const double reach_m =
      0.5 * o.window.width_m + (o.shutters.present ? ShutterReach_m(o.window.width_m) : 0.0);
  const double pitch_m = o.window.width_m + o.grid.gap_x_m;
  const int first = -std::max(o.grid.windows_left, 0);
  for (int column = first; column <= std::max(o.grid.windows_right, 0); ++column) {
    faults.Require(std::abs(pipe.x_m - column * pitch_m) >= reach_m + pipe.radius_m,
                   fmt::format("a drainpipe at x = {} m would stand before the windows or the "
                               "shutters of the column at x = {:g} m",
                               pipe.x_m, column * pitch_m));
  }
}

void CheckBeforeWindow(const FacadeOptions& o, Faults& faults) {
  const CableOptions& cables = o.cables;
  faults.Require(cables.count >= 0, fmt::format("cables must be 0 or more, not {}", cables.count));
  if (cables.count > 0) {
    faults.RequirePositive("cable_radius_m", cables.radius_m);
    faults.RequireNotNegative("cable_sag_m", cables.sag_m);
    faults.RequireNotNegative("cable_spacing_m", cables.spacing_m);
    faults.Require(std::isfinite(cables.height_m), "cable_height_m must be finite");
    faults.Require(cables.distance_m > cables.radius_m,
                   fmt::format("cables {} m before the wall must be thinner than {} m of radius",
                               cables.distance_m, cables.radius_m));
    CheckPaint("cable", cables.paint, faults);
  }
  const RailingOptions& railing = o.railing;
  if (!railing.present) return;
  faults.RequirePositive("railing_height_m", railing.height_m);
  faults.RequirePositive("railing_bar_radius_m", railing.bar_radius_m);
  faults.Require(
      railing.distance_m > railing.bar_radius_m,
      fmt::format("railing_distance_m must be greater than the bars' radius of {} m, not "
                  "{}",
                  railing.bar_radius_m, railing.distance_m));
  faults.Require(
      railing.bar_spacing_m > 2.0 * railing.bar_radius_m,
      fmt::format("railing_bar_spacing_m must be greater than a bar's thickness of {} m, "
                  "not {}",
                  2.0 * railing.bar_radius_m, railing.bar_spacing_m));
  CheckPaint("railing", railing.paint, faults);
}

void CheckCovers(const FacadeOptions& o, Faults& faults) {
  faults.RequireWithin("blind_coverage", o.blind.coverage, 0.0, 1.0);
  faults.RequirePositive("blind_slat_pitch_m", o.blind.slat_pitch_m);
  faults.RequireWithin("blind slat_tilt_rad", o.blind.slat_tilt_rad, 0.0, 0.5 * std::numbers::pi);
  CheckPaint("blind", o.blind.paint, faults);
  faults.RequireWithin("plant_coverage", o.plant.coverage, 0.0, kMostPlantCoverage);
  faults.RequirePositive("plant_leaf_length_m", o.plant.leaf_length_m);
  CheckPaint("plant", o.plant.paint, faults);
}

}  // namespace

void Validate(const FacadeOptions& options) {
  Faults faults("facade");
  CheckWall(options, faults);
  CheckWindow(options, faults);
  CheckGrid(options, faults);
  CheckRoom(options.room, faults);
  CheckAroundWindows(options, faults);
  CheckDrainpipe(options, faults);
  CheckBeforeWindow(options, faults);
  CheckCovers(options, faults);
  faults.Require(std::isfinite(options.seed), "facade_seed must be finite");
  faults.ThrowIfAny();
}

}  // namespace fenestra
