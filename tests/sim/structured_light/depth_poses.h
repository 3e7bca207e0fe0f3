#pragma once

#include <cstdint>

#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra::testing {

/// Puts a structured-light sensor of a quarter of the usual width at random poses around a facade,
/// from inside its wall to far away, looking anywhere. Returns the number of pixels with a depth
/// where the ray through the pixel hits nothing, or with both a depth and a reason for none.
int64_t DepthPixelsWhereNothingIs(DepthModel model, int poses, uint64_t seed);

}  // namespace fenestra::testing
