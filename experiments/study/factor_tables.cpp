#include "experiments/study/factor_tables.h"

#include <array>

#include "core/geometry/pose.h"

namespace fenestra {

// The field of the settings that a factor stands for.
#define FIELD(path) FENESTRA_FIELD(path)

void AddViewpointFactors(FactorTable& t) {
  t.Number("distance_m", FIELD(viewpoint.distance_m), {0.1, 100.0},
           "Distance from the window's centroid to the rig.")
      .Number("azimuth_deg", FIELD(viewpoint.azimuth_rad), {-89.0, 89.0, kDegree},
              "Direction of the rig as seen from the window, to the viewer's right.")
      .Number("elevation_deg", FIELD(viewpoint.elevation_rad), {-89.0, 89.0, kDegree},
              "Direction of the rig as seen from the window, upwards.")
      .Number("yaw_deg", FIELD(viewpoint.yaw_rad), {-180.0, 180.0, kDegree},
              "Turn of the rig to the right, away from looking at the centroid.")
      .Number("pitch_deg", FIELD(viewpoint.pitch_rad), {-180.0, 180.0, kDegree},
              "Turn of the rig upwards, after the yaw.")
      .Number("roll_deg", FIELD(viewpoint.roll_rad), {-180.0, 180.0, kDegree},
              "Turn of the rig clockwise about its optical axis, after the pitch.");
}

void AddSceneFactors(FactorTable& t) {
  t.Choice("scene", FIELD(scene), {kPaperTargetScene, kFacadeScene},
           "A black square painted on a wall, or a wall with a real window.")
      .Switch("target", FIELD(facade.with_target), "Whether there is a window to find.")
      .Number("window_width_m", FIELD(facade.window.width_m), {0.05, 20.0},
              "Outer width of the window frame.")
      .Number("window_height_m", FIELD(facade.window.height_m), {0.05, 20.0},
              "Outer height of the window frame.")
      .Number("frame_width_m", FIELD(facade.window.frame_width_m), {0.001, 5.0},
              "Width of the window frame's members or of the painted border, seen from the front.")
      .Number("wall_width_m", FIELD(facade.wall.width_m), {0.1, 200.0},
              "Width of the wall, which is centred on the window.")
      .Number("wall_height_m", FIELD(facade.wall.height_m), {0.1, 200.0},
              "Height of the wall, which is centred on the window.")
      .Number("wall_reflectance", FIELD(facade.wall.paint.reflectance), {0.0, 1.0},
              "Reflectance of the wall in visible light.")
      .Number("wall_reflectance_830nm", FIELD(facade.wall.paint.reflectance_830nm), {0.0, 1.0},
              "Reflectance of the wall in the projector's infra-red.")
      .Number("frame_reflectance", FIELD(facade.window.frame.reflectance), {0.0, 1.0},
              "Reflectance of the window frame in visible light.")
      .Number("frame_reflectance_830nm", FIELD(facade.window.frame.reflectance_830nm), {0.0, 1.0},
              "Reflectance of the window frame in the projector's infra-red.");
}

void AddLightFactors(FactorTable& t) {
  // 128 klx is the solar illuminance outside the atmosphere; a bright overcast sky gives 20 klx.
  t.Number("sun_illuminance_lx", FIELD(lighting.sun.illuminance_lx), {0.0, 128e3},
           "Illuminance by the sun on a plane perpendicular to its rays; 0: no sun.")
      .Number("sun_azimuth_deg", FIELD(lighting.sun.azimuth_rad), {-180.0, 180.0, kDegree},
              "Direction of the sun from the wall's normal, to the viewer's right.")
      .Number("sun_elevation_deg", FIELD(lighting.sun.elevation_rad), {0.0, 90.0, kDegree},
              "Height of the sun above the horizon.")
      .Number("sun_diameter_mrad", FIELD(lighting.sun.angular_diameter_rad), {0.0, 100.0, 1e-3},
              "Apparent diameter of the sun, which softens the edges of shadows; 0: a point.")
      .Number("sky_illuminance_lx", FIELD(lighting.sky.illuminance_lx), {0.0, 128e3},
              "Illuminance by the sky on an unobstructed horizontal plane.")
      .Choice("sky_model", FIELD(lighting.sky.model), {"uniform", "cie_overcast", "cie_clear"},
              "How the sky's light is spread over it; a clear sky follows the sun's position.")
      .Number("ground_reflectance", FIELD(lighting.sky.ground_reflectance), {0.0, 1.0},
              "Reflectance of the ground, which reflects the sky's and the sun's light.")
      .Number("ambient_830nm_ratio", FIELD(lighting.irradiance_830_per_lux),
              {0.0, 100.0, kDaylightIrradiance830PerLux},
              "Infra-red at 830 nm per lux of ambient light, in multiples of daylight's; 1: "
              "daylight, 0: LED lamps.");
}

void AddMotionFactors(FactorTable& t, const std::string& sensor, FactorTable::Field<RigMotion> of) {
  ParameterTable<RigMotion> motion;
  motion
      .Number(sensor + "_speed_right_m_s", FIELD(velocity_B.x()), {-100.0, 100.0},
              "Velocity of the rig to its right.")
      .Number(sensor + "_speed_down_m_s", FIELD(velocity_B.y()), {-100.0, 100.0},
              "Velocity of the rig downwards, along its own axis.")
      .Number(sensor + "_speed_forward_m_s", FIELD(velocity_B.z()), {-100.0, 100.0},
              "Velocity of the rig in the direction in which it looks.")
      .Number(sensor + "_pitch_rate_deg_s", FIELD(angular_velocity_B.x()),
              {-2000.0, 2000.0, kDegree}, "Rate at which the rig turns upwards.")
      .Number(sensor + "_yaw_rate_deg_s", FIELD(angular_velocity_B.y()), {-2000.0, 2000.0, kDegree},
              "Rate at which the rig turns to the right.")
      .Number(sensor + "_roll_rate_deg_s", FIELD(angular_velocity_B.z()),
              {-2000.0, 2000.0, kDegree}, "Rate at which the rig turns clockwise.");
  t.Adopt<RigMotion>(motion, of);
}

#undef FIELD

}  // namespace fenestra
