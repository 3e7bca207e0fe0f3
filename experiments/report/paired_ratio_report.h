#pragma once

#include <span>
#include <string>

#include "experiments/analysis/paired_ratio.h"

namespace fenestra {

/// A table of all pairs of cells, and for each part, detector and level the pooled ratios.
std::string PairedRatioTable(std::span<const PairedCells> cells, const std::string& factor,
                             const RandomStream& stream);

}  // namespace fenestra
