#include "core/geometry/pose.h"
#include "experiments/study/factor_tables.h"
#include "scenes/facade/facade_plan.h"
#include "scenes/facade/wall_texture.h"

namespace fenestra {
namespace {

const FactorTable::Range kUnit{0.0, 1.0};

// The field of the settings that a factor stands for.
#define FIELD(path) FENESTRA_FIELD(path)

void AddWall(FactorTable& t) {
  t.Number("wall_thickness_m", FIELD(facade.wall.thickness_m), {0.01, 2.0},
           "Thickness of the wall, which is the depth of the reveal.")
      .Choice("wall_hue", FIELD(facade.wall.paint.hue), HueNames(), "Hue of the wall.")
      .Choice("wall_finish", FIELD(facade.wall.finish), WallFinishNames(),
              "What the wall is made of; has no effect at a texture contrast of 0.")
      .Number("texture_contrast", FIELD(facade.wall.texture_contrast), {0.0, kMostTextureContrast},
              "Standard deviation over mean of the wall's reflectance; 0: no texture.")
      .Number("texture_scale", FIELD(facade.wall.texture_scale), {0.1, 10.0},
              "Factor by which all lengths of the wall's texture are multiplied.")
      .Number("facade_seed", FIELD(facade.seed), {0.0, 1e9},
              "Seed of all that is random about a facade; equal seeds give equal facades.");
}

void AddWindow(FactorTable& t) {
  t.Number("frame_depth_m", FIELD(facade.window.frame_depth_m), {0.001, 1.0},
           "Depth of the window frame along the wall's normal.")
      .Number("frame_setback_m", FIELD(facade.window.setback_m), {0.0, 1.0},
              "Distance of the window frame's front behind the wall's outer face.")
      .Choice("frame_hue", FIELD(facade.window.frame.hue), HueNames(), "Hue of the window frame.")
      .Integer("vertical_mullions", FIELD(facade.window.vertical_mullions), {0, 10},
               "Number of upright bars within the window frame, painted like it.")
      .Integer("horizontal_mullions", FIELD(facade.window.horizontal_mullions), {0, 10},
               "Number of level bars within the window frame, painted like it.")
      .Number("mullion_width_m", FIELD(facade.window.mullion_width_m), {0.005, 0.5},
              "Width of each bar within the window frame.")
      .Switch("glass", FIELD(facade.window.glass), "Whether the windows have panes.")
      .Switch("double_glazing", FIELD(facade.window.double_glazing),
              "Whether windows have two panes, 16 mm apart, instead of one.");
}

void AddOtherWindows(FactorTable& t) {
  t.Integer("windows_left", FIELD(facade.grid.windows_left), {0, 5},
            "Number of columns of other windows to the viewer's left of the target.")
      .Integer("windows_right", FIELD(facade.grid.windows_right), {0, 5},
               "Number of columns of other windows to the viewer's right of the target.")
      .Integer("windows_above", FIELD(facade.grid.windows_above), {0, 5},
               "Number of rows of other windows above the target.")
      .Integer("windows_below", FIELD(facade.grid.windows_below), {0, 5},
               "Number of rows of other windows below the target.")
      .Number("window_gap_x_m", FIELD(facade.grid.gap_x_m), {0.11, 20.0},
              "Width of the wall between two windows side by side.")
      .Number("window_gap_y_m", FIELD(facade.grid.gap_y_m), {0.11, 20.0},
              "Height of the wall between two windows one above the other.")
      .Number("other_windows_share", FIELD(facade.grid.other_windows_share), {0.0, 1.0},
              "Probability that a place for another window has one.")
      .Number("other_frame_reflectance", FIELD(facade.grid.other_frame.reflectance), kUnit,
              "Reflectance of the other windows' frames in visible light.")
      .Number("other_frame_reflectance_830nm", FIELD(facade.grid.other_frame.reflectance_830nm),
              kUnit, "Reflectance of the other windows' frames in the projector's infra-red.")
      .Choice("other_frame_hue", FIELD(facade.grid.other_frame.hue), HueNames(),
              "Hue of the other windows' frames.");
}

void AddRooms(FactorTable& t) {
  t.Number("room_depth_m", FIELD(facade.room.depth_m), {0.1, 50.0},
           "Depth of the room behind each window.")
      .Number("room_reflectance", FIELD(facade.room.paint.reflectance), kUnit,
              "Reflectance of the rooms' surfaces in visible light.")
      .Number("room_reflectance_830nm", FIELD(facade.room.paint.reflectance_830nm), kUnit,
              "Reflectance of the rooms' surfaces in the projector's infra-red.")
      .Choice("room_hue", FIELD(facade.room.paint.hue), HueNames(), "Hue of the rooms' surfaces.")
      .Number("room_lamp_lm", FIELD(facade.room.lamp_lm), {0.0, 1e5},
              "Luminous flux of the ceiling lamp behind the target; 0: no lamp. A living room has "
              "1000 to 3000.")
      .Number("other_room_lamps_lm", FIELD(facade.room.other_lamps_lm), {0.0, 1e5},
              "Luminous flux of each ceiling lamp behind the other windows; 0: no lamps.")
      .Number("room_lamp_830nm_ratio", FIELD(facade.room.lamp_irradiance_830_per_lux),
              {0.0, 100.0, kDaylightIrradiance830PerLux},
              "Infra-red at 830 nm per lux of the ceiling lamps, in multiples of daylight's; 0: "
              "LED lamps.");
}

void AddStonework(FactorTable& t) {
  t.Switch("sill", FIELD(facade.sill.present), "Whether there is a slab below each window.")
      .Number("sill_projection_m", FIELD(facade.sill.projection_m), {0.0, 0.5},
              "Projection of the sills from the wall.")
      .Number("sill_overhang_m", FIELD(facade.sill.overhang_m), {0.0, 0.5},
              "Length of the sills beyond the opening, on each side.")
      .Number("sill_thickness_m", FIELD(facade.sill.thickness_m), {0.005, 0.5},
              "Thickness of the sills.")
      .Number("sill_reflectance", FIELD(facade.sill.paint.reflectance), kUnit,
              "Reflectance of the sills in visible light.")
      .Number("sill_reflectance_830nm", FIELD(facade.sill.paint.reflectance_830nm), kUnit,
              "Reflectance of the sills in the projector's infra-red.")
      .Choice("sill_hue", FIELD(facade.sill.paint.hue), HueNames(), "Hue of the sills.")
      .Switch("lintel", FIELD(facade.lintel.present), "Whether there is a band above each window.")
      .Number("lintel_height_m", FIELD(facade.lintel.height_m), {0.01, 1.0},
              "Height of the lintels.")
      .Number("lintel_overhang_m", FIELD(facade.lintel.overhang_m), {0.0, 0.5},
              "Length of the lintels beyond the opening, on each side.")
      .Number("lintel_projection_m", FIELD(facade.lintel.projection_m), {0.0, 0.5},
              "Projection of the lintels from the wall.")
      .Number("lintel_reflectance", FIELD(facade.lintel.paint.reflectance), kUnit,
              "Reflectance of the lintels in visible light.")
      .Number("lintel_reflectance_830nm", FIELD(facade.lintel.paint.reflectance_830nm), kUnit,
              "Reflectance of the lintels in the projector's infra-red.")
      .Choice("lintel_hue", FIELD(facade.lintel.paint.hue), HueNames(), "Hue of the lintels.")
      .Switch("shutters", FIELD(facade.shutters.present),
              "Whether there are open shutters beside each window.")
      .Switch("shutters_louvred", FIELD(facade.shutters.louvred),
              "Whether the shutters have slats in a rim instead of boards.")
      .Number("shutter_reflectance", FIELD(facade.shutters.paint.reflectance), kUnit,
              "Reflectance of the shutters in visible light.")
      .Number("shutter_reflectance_830nm", FIELD(facade.shutters.paint.reflectance_830nm), kUnit,
              "Reflectance of the shutters in the projector's infra-red.")
      .Choice("shutter_hue", FIELD(facade.shutters.paint.hue), HueNames(), "Hue of the shutters.");
}

void AddPipework(FactorTable& t) {
  t.Switch("drainpipe", FIELD(facade.drainpipe.present),
           "Whether there is an upright pipe before the wall.")
      .Number("drainpipe_x_m", FIELD(facade.drainpipe.x_m), {-100.0, 100.0},
              "Position of the drainpipe's axis to the right of the target's centroid.")
      .Number("drainpipe_radius_m", FIELD(facade.drainpipe.radius_m), {0.01, 0.5},
              "Radius of the drainpipe.")
      .Number("drainpipe_clearance_m", FIELD(facade.drainpipe.clearance_m), {0.0, 0.5},
              "Gap between the wall and the drainpipe.")
      .Number("drainpipe_reflectance", FIELD(facade.drainpipe.paint.reflectance), kUnit,
              "Reflectance of the drainpipe in visible light.")
      .Number("drainpipe_reflectance_830nm", FIELD(facade.drainpipe.paint.reflectance_830nm), kUnit,
              "Reflectance of the drainpipe in the projector's infra-red.")
      .Choice("drainpipe_hue", FIELD(facade.drainpipe.paint.hue), HueNames(),
              "Hue of the drainpipe.")
      .Integer("cables", FIELD(facade.cables.count), {0, 10},
               "Number of cables that hang across the facade; they may cross the window.")
      .Number("cable_height_m", FIELD(facade.cables.height_m), {-20.0, 20.0},
              "Height of the lowest cable's lowest point above the target's centroid.")
      .Number("cable_spacing_m", FIELD(facade.cables.spacing_m), {0.0, 2.0},
              "Distance from one cable to the next.")
      .Number("cable_distance_m", FIELD(facade.cables.distance_m), {0.01, 5.0},
              "Distance of the cables from the wall.")
      .Number("cable_radius_m", FIELD(facade.cables.radius_m), {0.001, 0.1},
              "Radius of each cable.")
      .Number("cable_sag_m", FIELD(facade.cables.sag_m), {0.0, 5.0}, "Mean sag of the cables.")
      .Number("cable_reflectance", FIELD(facade.cables.paint.reflectance), kUnit,
              "Reflectance of the cables in visible light.")
      .Number("cable_reflectance_830nm", FIELD(facade.cables.paint.reflectance_830nm), kUnit,
              "Reflectance of the cables in the projector's infra-red.")
      .Choice("cable_hue", FIELD(facade.cables.paint.hue), HueNames(), "Hue of the cables.")
      .Switch("railing", FIELD(facade.railing.present), "Whether there are bars before the target.")
      .Number("railing_height_m", FIELD(facade.railing.height_m), {0.05, 5.0},
              "Height of the hand rail above the window's lower edge.")
      .Number("railing_distance_m", FIELD(facade.railing.distance_m), {0.02, 3.0},
              "Distance of the railing from the wall.")
      .Number("railing_bar_spacing_m", FIELD(facade.railing.bar_spacing_m), {0.02, 1.0},
              "Distance from one bar of the railing to the next.")
      .Number("railing_bar_radius_m", FIELD(facade.railing.bar_radius_m), {0.002, 0.1},
              "Radius of each bar of the railing.")
      .Number("railing_reflectance", FIELD(facade.railing.paint.reflectance), kUnit,
              "Reflectance of the railing in visible light.")
      .Number("railing_reflectance_830nm", FIELD(facade.railing.paint.reflectance_830nm), kUnit,
              "Reflectance of the railing in the projector's infra-red.")
      .Choice("railing_hue", FIELD(facade.railing.paint.hue), HueNames(), "Hue of the railing.");
}

void AddCovers(FactorTable& t) {
  t.Number("blind_coverage", FIELD(facade.blind.coverage), {0.0, 1.0},
           "Share of the target's height that its blind covers, from the top; 0: no blinds at all.")
      .Switch("blind_outside", FIELD(facade.blind.outside),
              "Whether blinds hang before the frames instead of behind the panes.")
      .Switch("blind_slatted", FIELD(facade.blind.slatted),
              "Whether the blinds have slats instead of a sheet.")
      .Number("blind_slat_pitch_m", FIELD(facade.blind.slat_pitch_m), {0.01, 0.3},
              "Distance from one slat to the next.")
      .Number("blind_slat_tilt_deg", FIELD(facade.blind.slat_tilt_rad), {0.0, 90.0, kDegree},
              "Tilt of the slats: 0 open, 60 just closed.")
      .Number("blind_reflectance", FIELD(facade.blind.paint.reflectance), kUnit,
              "Reflectance of the blinds in visible light.")
      .Number("blind_reflectance_830nm", FIELD(facade.blind.paint.reflectance_830nm), kUnit,
              "Reflectance of the blinds in the projector's infra-red.")
      .Choice("blind_hue", FIELD(facade.blind.paint.hue), HueNames(), "Hue of the blinds.")
      .Number("plant_coverage", FIELD(facade.plant.coverage), {0.0, kMostPlantCoverage},
              "Share of the target's frame that leaves hide, seen from its front.")
      .Number("plant_leaf_length_m", FIELD(facade.plant.leaf_length_m), {0.02, 0.5},
              "Mean length of the leaves.")
      .Number("plant_reflectance", FIELD(facade.plant.paint.reflectance), kUnit,
              "Reflectance of the lightest leaves in visible light.")
      .Number("plant_reflectance_830nm", FIELD(facade.plant.paint.reflectance_830nm), kUnit,
              "Reflectance of the lightest leaves in the projector's infra-red.")
      .Choice("plant_hue", FIELD(facade.plant.paint.hue), HueNames(),
              "Hue of the lightest leaves.");
}

#undef FIELD

}  // namespace

void AddFacadeFactors(FactorTable& table) {
  AddWall(table);
  AddWindow(table);
  AddOtherWindows(table);
  AddRooms(table);
  AddStonework(table);
  AddPipework(table);
  AddCovers(table);
}

}  // namespace fenestra
