#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "scenes/paint.h"

namespace fenestra {

// Where no source is given, sizes and reflectances are ordinary ones, chosen by us.

/// The material whose look a wall's texture has; see MakeWallPattern.
enum class WallFinish { kPlaster, kBrick, kConcrete, kCladding };

/// The names of the finishes, in order: plaster, brick, ...
inline const std::vector<std::string>& WallFinishNames() {
  static const std::vector<std::string> names = {"plaster", "brick", "concrete", "cladding"};
  return names;
}

struct WallOptions {
  double width_m = 12.0;  ///< The wall is centred on the target.
  double height_m = 8.0;
  double thickness_m = 0.30;  ///< The reveal runs from the outer face to here.
  Paint paint{.reflectance = 0.80, .reflectance_830nm = 0.80};  ///< Mean over the texture.
  WallFinish finish = WallFinish::kPlaster;
  double texture_contrast = 0.0;  ///< Standard deviation over mean; 0: no texture at all.
  double texture_scale = 1.0;     ///< Multiplies all lengths of the texture.
};

/// The target window. All other windows share its sizes, glazing and depth.
struct WindowOptions {
  double width_m = 1.0;  ///< Outer width of the window frame, which fills the opening.
  double height_m = 1.0;
  double frame_width_m = 0.10;  ///< Width of the frame's members, seen from the front.
  double frame_depth_m = 0.06;  ///< Depth of the frame along the wall's normal.
  double setback_m = 0.0;       ///< Distance of the frame's front behind the wall's outer face.
  Paint frame{.reflectance = 0.05, .reflectance_830nm = 0.05};  ///< Paint of the target's frame.
  int vertical_mullions = 0;    ///< Upright bars within the frame, with its paint and depth.
  int horizontal_mullions = 0;  ///< Horizontal bars within the frame.
  double mullion_width_m = 0.04;
  bool glass = true;            ///< A pane in the middle of the frame's depth.
  bool double_glazing = false;  ///< Two panes, 16 mm apart.
};

/// Windows around the target, in rows and columns; all but the target have a frame of their own.
struct GridOptions {
  int windows_left = 0;  ///< Columns to the viewer's left of the target's.
  int windows_right = 0;
  int windows_above = 0;  ///< Rows above the target's.
  int windows_below = 0;
  double gap_x_m = 0.8;              ///< Width of the wall between two openings, horizontally.
  double gap_y_m = 1.2;              ///< Height of the wall between two openings.
  double other_windows_share = 1.0;  ///< Probability that each of the other windows exists.
  Paint other_frame{.reflectance = 0.70, .reflectance_830nm = 0.70};
};

/// Behind each window is a room of its own.
struct RoomOptions {
  double depth_m = 4.0;  ///< Behind the wall's inner face.
  Paint paint{.reflectance = 0.30, .reflectance_830nm = 0.30};
  double lamp_lm = 0.0;         ///< Flux of the ceiling lamp in the target's room; 0: no lamp.
  double other_lamps_lm = 0.0;  ///< Flux of the ceiling lamp in each other room.
  double lamp_irradiance_830_per_lux = 0.0;  ///< See Lamp; 0: LED.
};

/// A slab below each window, which projects from the wall.
struct SillOptions {
  bool present = false;
  double projection_m = 0.05;
  double overhang_m = 0.04;  ///< Length beyond the opening, on both sides.
  double thickness_m = 0.04;
  Paint paint{.reflectance = 0.45, .reflectance_830nm = 0.45};
};

/// A band above each window.
struct LintelOptions {
  bool present = false;
  double height_m = 0.15;
  double overhang_m = 0.12;
  double projection_m = 0.0;
  Paint paint{.reflectance = 0.45, .reflectance_830nm = 0.45};
};

/// Two open leaves beside each window, each as wide as half the opening.
struct ShutterOptions {
  bool present = false;
  bool louvred = true;
  Paint paint{.reflectance = 0.15, .reflectance_830nm = 0.40, .hue = Hue::kGreen};
};

/// A vertical pipe over the wall's whole height.
struct DrainpipeOptions {
  bool present = false;
  double x_m = 0.9;  ///< Distance of its axis to the right of the target's centroid.
  double radius_m = 0.05;
  double clearance_m = 0.03;  ///< Gap between wall and pipe.
  Paint paint{.reflectance = 0.40, .reflectance_830nm = 0.40};
};

/// Cables that hang before the facade from edge to edge. They may cross the window.
struct CableOptions {
  int count = 0;
  double height_m = 0.45;    ///< Height of the lowest point above the target's centroid.
  double spacing_m = 0.06;   ///< Distance from cable to cable, upwards.
  double distance_m = 0.20;  ///< Distance of their axes from the wall, clear of the drainpipe.
  double radius_m = 0.008;
  double sag_m = 0.15;  ///< Mean sag; each cable's is drawn from 0.7 to 1.3 of it.
  Paint paint{.reflectance = 0.06, .reflectance_830nm = 0.20};
};

/// A railing before the target: upright bars between two rails.
struct RailingOptions {
  bool present = false;
  double height_m = 0.40;       ///< Height of the hand rail above the opening's lower edge.
  double distance_m = 0.12;     ///< Distance of the bars' axes from the wall.
  double bar_spacing_m = 0.11;  ///< Between axes: a child's head must not pass (DIN 18065: 12 cm).
  double bar_radius_m = 0.008;
  Paint paint{.reflectance = 0.08, .reflectance_830nm = 0.20};
};

/// A blind that is let down by a given share. If the target has one, so have all other windows,
/// each let down at random.
struct BlindOptions {
  /// Share of the height that is covered; 0: no blind. Outside, it is a share of the frame's front,
  /// and the blind covers frame and glass. Inside, it is a share of what the frame leaves open.
  double coverage = 0.0;
  bool outside = false;
  bool slatted = true;  ///< true: a venetian blind; false: a sheet.
  double slat_pitch_m = 0.05;
  double slat_tilt_rad = std::numbers::pi / 3.0;  ///< 0: flat and open. 60°: just closed.
  Paint paint{.reflectance = 0.60, .reflectance_830nm = 0.60};
};

/// Clusters of leaves before the target's frame.
struct PlantOptions {
  /// Share of the frame's front that leaves cover, seen along the normal; 0: no plant.
  double coverage = 0.0;
  double leaf_length_m = 0.07;
  /// Leaves reflect about 0.1 of green light and half of the near infra-red: E. B. Knipling,
  /// Remote Sensing of Environment 1 (1970), 155-159.
  Paint paint{.reflectance = 0.10, .reflectance_830nm = 0.50, .hue = Hue::kGreen};
};

/// A facade: a wall, a grid of windows of which one is the target, and what hangs on it. By default
/// a plain wall with one real window: an opening, its reveal, a frame, a pane and a dark room.
struct FacadeOptions {
  bool with_target = true;  ///< false: there is wall in its place; other windows stay.
  WallOptions wall{};
  WindowOptions window{};
  GridOptions grid{};
  RoomOptions room{};
  SillOptions sill{};
  LintelOptions lintel{};
  ShutterOptions shutters{};
  DrainpipeOptions drainpipe{};
  CableOptions cables{};
  RailingOptions railing{};
  BlindOptions blind{};
  PlantOptions plant{};
  /// Seed of all random choices. Equal numbers, whole or not, give equal facades. Each element
  /// draws from its own stream, so that an element that is added does not change the others.
  double seed = 1.0;
};

}  // namespace fenestra
