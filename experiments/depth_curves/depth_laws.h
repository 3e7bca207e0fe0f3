#pragma once

#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra {

/// Published laws of a structured-light sensor's depth; z [m], angles [rad].

/// K. Khoshelham and S. Elberink, "Accuracy and resolution of Kinect depth data", 2012:
/// σ = 1.425e-3 z² [m], noise and fixed pattern together.
double KhoshelhamSigma(double z_m);

/// C. V. Nguyen, S. Izadi and D. Lovell, "Modeling Kinect sensor noise", 2012, axial:
/// 0.0012 + 0.0019 (z - 0.4)² up to 60°, and beyond 0.0001/√z θ²/(π/2 - θ)² more [m].
double NguyenSigma(double z_m, double angle_rad);

/// Nguyen's lateral noise: 0.8 + 0.035 θ/(π/2 - θ) [px of a 640-wide image].
double NguyenLateralSigma(double angle_rad);

/// Distance between two depths that can occur: 2.85e-3 z² with OpenNI (Khoshelham & Elberink),
/// 1.45e-3 z² with the Microsoft SDK (levels of its depth table below 4.46 m) [m].
double OpenNiStep(double z_m);
double MicrosoftStep(double z_m);

/// Predictions from a sensor's constants, before anything is simulated: where the expected
/// correlation of a block (InfraredResponse::Correlation) becomes too small to be accepted. For a
/// wall of this 830 nm reflectance at distance z, facing the sensor: the illuminance of the wall by
/// daylight [lx].
double PredictedAmbientLimit(const StructuredLightOptions& options, double reflectance, double z_m);

/// The distance [m] at which dots on a surface of this reflectance are too dim without other light.
double PredictedReach(const StructuredLightOptions& options, double reflectance);

/// Width of the projector's shadow left of a plate at zo before a wall at zb [px of a 640-wide
/// image]:  f b (1/zo - 1/zb).
double ShadowWidth(const StructuredLightOptions& options, double zo_m, double zb_m);

}  // namespace fenestra
