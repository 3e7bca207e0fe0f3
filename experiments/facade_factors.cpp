#include "experiments/facade_factors.h"

#include "core/pose.h"
#include "scenes/facade_plan.h"
#include "scenes/wall_texture.h"

namespace fenestra {
namespace {

using Table = ParameterTable<TrialSettings>;

const Table::Range kUnit{0.0, 1.0};

// The field of the settings that a factor stands for.
// clang-format off
#define FIELD(path) [](TrialSettings& s) -> auto& { return s.path; }
// clang-format on

void AddWall(Table& t) {
  t.Number("wall_thickness_m", FIELD(facade.wall.thickness_m), {0.01, 2.0},
           "Of the wall, which is the depth of the reveal.")
      .Choice("wall_hue", FIELD(facade.wall.paint.hue), HueNames(), "Colour of the wall.")
      .Choice("wall_finish", FIELD(facade.wall.finish), WallFinishNames(),
              "What the wall is made of; without effect at a contrast of 0.")
      .Number("texture_contrast", FIELD(facade.wall.texture_contrast), {0.0, kMostTextureContrast},
              "Standard deviation over mean of the wall's reflectance; 0: no texture.")
      .Number("texture_scale", FIELD(facade.wall.texture_scale), {0.1, 10.0},
              "Multiplies all lengths of the texture.")
      .Number("facade_seed", FIELD(facade.seed), {0.0, 1e9},
              "Chooses all that is random about a facade; equal numbers give equal facades.");
}

void AddWindow(Table& t) {
  t.Number("frame_depth_m", FIELD(facade.window.frame_depth_m), {0.001, 1.0},
           "Of the frame, along the wall's normal.")
      .Number("frame_setback_m", FIELD(facade.window.setback_m), {0.0, 1.0},
              "Front of the frame behind the wall's outer face.")
      .Choice("frame_hue", FIELD(facade.window.frame.hue), HueNames(), "Colour of the frame.")
      .Integer("vertical_mullions", FIELD(facade.window.vertical_mullions), {0, 10},
               "Upright bars within the frame, of its paint.")
      .Integer("horizontal_mullions", FIELD(facade.window.horizontal_mullions), {0, 10},
               "Level bars within the frame, of its paint.")
      .Number("mullion_width_m", FIELD(facade.window.mullion_width_m), {0.005, 0.5},
              "Of each bar within the frame.")
      .Switch("glass", FIELD(facade.window.glass), "Whether the windows have panes.")
      .Switch("double_glazing", FIELD(facade.window.double_glazing),
              "Two panes, 16 mm apart, instead of one.");
}

void AddOtherWindows(Table& t) {
  t.Integer("windows_left", FIELD(facade.grid.windows_left), {0, 5},
            "Columns of other windows to the viewer's left of the target.")
      .Integer("windows_right", FIELD(facade.grid.windows_right), {0, 5},
               "Columns of other windows to the viewer's right of the target.")
      .Integer("windows_above", FIELD(facade.grid.windows_above), {0, 5},
               "Rows of other windows above the target.")
      .Integer("windows_below", FIELD(facade.grid.windows_below), {0, 5},
               "Rows of other windows below the target.")
      .Number("window_gap_x_m", FIELD(facade.grid.gap_x_m), {0.11, 20.0},
              "Wall between two windows side by side.")
      .Number("window_gap_y_m", FIELD(facade.grid.gap_y_m), {0.11, 20.0},
              "Wall between two windows one above the other.")
      .Number("other_windows_share", FIELD(facade.grid.other_windows_share), {0.0, 1.0},
              "Probability with which each place has its window.")
      .Number("other_frame_reflectance", FIELD(facade.grid.other_frame.reflectance), kUnit,
              "Of the other windows' frames, in visible light.")
      .Number("other_frame_reflectance_830nm", FIELD(facade.grid.other_frame.reflectance_830nm),
              kUnit, "Of the other windows' frames, in the projector's infra-red.")
      .Choice("other_frame_hue", FIELD(facade.grid.other_frame.hue), HueNames(),
              "Of the other windows' frames.");
}

void AddRooms(Table& t) {
  t.Number("room_depth_m", FIELD(facade.room.depth_m), {0.1, 50.0},
           "Of the room behind each window.")
      .Number("room_reflectance", FIELD(facade.room.paint.reflectance), kUnit,
              "Of the rooms' surfaces, in visible light.")
      .Number("room_reflectance_830nm", FIELD(facade.room.paint.reflectance_830nm), kUnit,
              "Of the rooms' surfaces, in the projector's infra-red.")
      .Choice("room_hue", FIELD(facade.room.paint.hue), HueNames(), "Of the rooms' surfaces.")
      .Number("room_lamp_lm", FIELD(facade.room.lamp_lm), {0.0, 1e5},
              "Of the ceiling lamp behind the target; 0: none. A living room has 1000 to 3000.")
      .Number("other_room_lamps_lm", FIELD(facade.room.other_lamps_lm), {0.0, 1e5},
              "Of each ceiling lamp behind the other windows; 0: none.")
      .Number("room_lamp_830nm_ratio", FIELD(facade.room.lamp_irradiance_830_per_lux),
              {0.0, 100.0, kDaylightIrradiance830PerLux},
              "Infra-red at 830 nm per lux of the ceiling lamps, in multiples of daylight's: 0 LED "
              "lamps.");
}

void AddStonework(Table& t) {
  t.Switch("sill", FIELD(facade.sill.present), "A slab below each window.")
      .Number("sill_projection_m", FIELD(facade.sill.projection_m), {0.0, 0.5}, "Before the wall.")
      .Number("sill_overhang_m", FIELD(facade.sill.overhang_m), {0.0, 0.5},
              "Beyond the opening, on both sides.")
      .Number("sill_thickness_m", FIELD(facade.sill.thickness_m), {0.005, 0.5}, "From below.")
      .Number("sill_reflectance", FIELD(facade.sill.paint.reflectance), kUnit,
              "Of the sills, in visible light.")
      .Number("sill_reflectance_830nm", FIELD(facade.sill.paint.reflectance_830nm), kUnit,
              "Of the sills, in the projector's infra-red.")
      .Choice("sill_hue", FIELD(facade.sill.paint.hue), HueNames(), "Of the sills.")
      .Switch("lintel", FIELD(facade.lintel.present), "A band above each window.")
      .Number("lintel_height_m", FIELD(facade.lintel.height_m), {0.01, 1.0}, "Of the band.")
      .Number("lintel_overhang_m", FIELD(facade.lintel.overhang_m), {0.0, 0.5},
              "Beyond the opening, on both sides.")
      .Number("lintel_projection_m", FIELD(facade.lintel.projection_m), {0.0, 0.5},
              "Before the wall.")
      .Number("lintel_reflectance", FIELD(facade.lintel.paint.reflectance), kUnit,
              "Of the lintels, in visible light.")
      .Number("lintel_reflectance_830nm", FIELD(facade.lintel.paint.reflectance_830nm), kUnit,
              "Of the lintels, in the projector's infra-red.")
      .Choice("lintel_hue", FIELD(facade.lintel.paint.hue), HueNames(), "Of the lintels.")
      .Switch("shutters", FIELD(facade.shutters.present), "Open shutters beside each window.")
      .Switch("shutters_louvred", FIELD(facade.shutters.louvred),
              "Slats in a rim instead of boards.")
      .Number("shutter_reflectance", FIELD(facade.shutters.paint.reflectance), kUnit,
              "Of the shutters, in visible light.")
      .Number("shutter_reflectance_830nm", FIELD(facade.shutters.paint.reflectance_830nm), kUnit,
              "Of the shutters, in the projector's infra-red.")
      .Choice("shutter_hue", FIELD(facade.shutters.paint.hue), HueNames(), "Of the shutters.");
}

void AddPipework(Table& t) {
  t.Switch("drainpipe", FIELD(facade.drainpipe.present), "An upright pipe before the wall.")
      .Number("drainpipe_x_m", FIELD(facade.drainpipe.x_m), {-100.0, 100.0},
              "Its axis to the right of the target's centroid.")
      .Number("drainpipe_radius_m", FIELD(facade.drainpipe.radius_m), {0.01, 0.5}, "Of the pipe.")
      .Number("drainpipe_clearance_m", FIELD(facade.drainpipe.clearance_m), {0.0, 0.5},
              "Between wall and pipe.")
      .Number("drainpipe_reflectance", FIELD(facade.drainpipe.paint.reflectance), kUnit,
              "Of the pipe, in visible light.")
      .Number("drainpipe_reflectance_830nm", FIELD(facade.drainpipe.paint.reflectance_830nm), kUnit,
              "Of the pipe, in the projector's infra-red.")
      .Choice("drainpipe_hue", FIELD(facade.drainpipe.paint.hue), HueNames(), "Of the pipe.")
      .Integer("cables", FIELD(facade.cables.count), {0, 10},
               "How many hang across the facade; they may cross the window.")
      .Number("cable_height_m", FIELD(facade.cables.height_m), {-20.0, 20.0},
              "Lowest point of the lowest cable above the target's centroid.")
      .Number("cable_spacing_m", FIELD(facade.cables.spacing_m), {0.0, 2.0}, "From cable to cable.")
      .Number("cable_distance_m", FIELD(facade.cables.distance_m), {0.01, 5.0}, "From the wall.")
      .Number("cable_radius_m", FIELD(facade.cables.radius_m), {0.001, 0.1}, "Of each cable.")
      .Number("cable_sag_m", FIELD(facade.cables.sag_m), {0.0, 5.0}, "Mean of the cables' sags.")
      .Number("cable_reflectance", FIELD(facade.cables.paint.reflectance), kUnit,
              "Of the cables, in visible light.")
      .Number("cable_reflectance_830nm", FIELD(facade.cables.paint.reflectance_830nm), kUnit,
              "Of the cables, in the projector's infra-red.")
      .Choice("cable_hue", FIELD(facade.cables.paint.hue), HueNames(), "Of the cables.")
      .Switch("railing", FIELD(facade.railing.present), "Bars before the target.")
      .Number("railing_height_m", FIELD(facade.railing.height_m), {0.05, 5.0},
              "Of the hand rail above the window's lower edge.")
      .Number("railing_distance_m", FIELD(facade.railing.distance_m), {0.02, 3.0}, "From the wall.")
      .Number("railing_bar_spacing_m", FIELD(facade.railing.bar_spacing_m), {0.02, 1.0},
              "From bar to bar.")
      .Number("railing_bar_radius_m", FIELD(facade.railing.bar_radius_m), {0.002, 0.1},
              "Of each bar.")
      .Number("railing_reflectance", FIELD(facade.railing.paint.reflectance), kUnit,
              "Of the railing, in visible light.")
      .Number("railing_reflectance_830nm", FIELD(facade.railing.paint.reflectance_830nm), kUnit,
              "Of the railing, in the projector's infra-red.")
      .Choice("railing_hue", FIELD(facade.railing.paint.hue), HueNames(), "Of the railing.");
}

void AddCovers(Table& t) {
  t.Number("blind_coverage", FIELD(facade.blind.coverage), {0.0, 1.0},
           "How far the target's blind is let down; 0: no blinds at all.")
      .Switch("blind_outside", FIELD(facade.blind.outside),
              "Blinds before the frames instead of behind the panes.")
      .Switch("blind_slatted", FIELD(facade.blind.slatted), "Slats instead of a sheet.")
      .Number("blind_slat_pitch_m", FIELD(facade.blind.slat_pitch_m), {0.01, 0.3},
              "From slat to slat.")
      .Number("blind_slat_tilt_deg", FIELD(facade.blind.slat_tilt_rad), {0.0, 90.0, kDegree},
              "Of the slats: 0 open, 60 just closed.")
      .Number("blind_reflectance", FIELD(facade.blind.paint.reflectance), kUnit,
              "Of the blinds, in visible light.")
      .Number("blind_reflectance_830nm", FIELD(facade.blind.paint.reflectance_830nm), kUnit,
              "Of the blinds, in the projector's infra-red.")
      .Choice("blind_hue", FIELD(facade.blind.paint.hue), HueNames(), "Of the blinds.")
      .Number("plant_coverage", FIELD(facade.plant.coverage), {0.0, kMostPlantCoverage},
              "Share of the target's frame behind leaves, seen from its front.")
      .Number("plant_leaf_length_m", FIELD(facade.plant.leaf_length_m), {0.02, 0.5},
              "Mean length of a leaf.")
      .Number("plant_reflectance", FIELD(facade.plant.paint.reflectance), kUnit,
              "Of the lightest leaves, in visible light.")
      .Number("plant_reflectance_830nm", FIELD(facade.plant.paint.reflectance_830nm), kUnit,
              "Of the lightest leaves, in the projector's infra-red.")
      .Choice("plant_hue", FIELD(facade.plant.paint.hue), HueNames(), "Of the lightest leaves.");
}

#undef FIELD

}  // namespace

void AddFacadeFactors(ParameterTable<TrialSettings>& table) {
  AddWall(table);
  AddWindow(table);
  AddOtherWindows(table);
  AddRooms(table);
  AddStonework(table);
  AddPipework(table);
  AddCovers(table);
}

}  // namespace fenestra
