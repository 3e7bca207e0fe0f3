#pragma once

#include <cstdint>

#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra::testing {

/// Depth pixels whose blocks see nothing at all, and how many of them have a depth, by chance.
struct DepthOfNothing {
  int64_t pixels = 0;
  int64_t returns = 0;
  /// Pixels, of all, with both a depth and a reason for having none, or with neither.
  int64_t unexplained = 0;
};

/// Over random poses around a facade, from inside its wall to 100 m away, looking anywhere.
DepthOfNothing DepthWhereNothingIs(DepthModel model, int poses, uint64_t seed);

}  // namespace fenestra::testing
