#pragma once

#include <array>
#include <vector>

#include "vision/frame/adjustment/frame_fit.h"

namespace fenestra {

/// Counts for each side.
using SideCounts = std::array<int, 4>;

/// Number of places along the sides at which an edge was looked for, for each view.
struct PlaceCounts {
  std::vector<SideCounts> outer;
  std::vector<SideCounts> inner;
};

/// Stores in the fit the shares of these places whose edge the fit explains.
void CountSupport(const PlaceCounts& places, FrameFit& fit);

}  // namespace fenestra
