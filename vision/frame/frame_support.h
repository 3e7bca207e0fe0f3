#pragma once

#include <array>
#include <vector>

#include "vision/frame/frame_fit.h"

namespace fenestra {

/// By side.
using SideCounts = std::array<int, 4>;

/// Places along the sides where an edge was looked for, by view.
struct PlaceCounts {
  std::vector<SideCounts> outer;
  std::vector<SideCounts> inner;
};

/// Puts in the fit of how many of them it explains the edge.
void CountSupport(const PlaceCounts& places, FrameFit& fit);

}  // namespace fenestra
