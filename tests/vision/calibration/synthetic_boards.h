#pragma once

#include <vector>

#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "vision/calibration/stereo_calibration.h"

namespace fenestra::testing {

/// A stereo pair with distinct cameras: 752 x 480 px, f about 667 px, 35 cm apart.
StereoCalibration ExamplePair();

/// Boards in front of a pair, tilted in all directions, and their corners with white noise.
std::vector<NamedView> SyntheticViews(const StereoCalibration& pair, const CalibrationBoard& board,
                                      int count, double noise_px, const RandomStream& stream,
                                      double largest_tilt_rad = 0.6);

inline const StereoCalibratorOptions kExampleSizes{
    .left_size = {752, 480}, .right_size = {752, 480}, .adjustment = {}};

}  // namespace fenestra::testing
