#pragma once

#include <span>
#include <string>

#include "experiments/analysis/detector_comparison.h"

namespace fenestra {

/// comparison.csv: one line for each comparison, lengths in mm, rates as fractions, with 95 %
/// intervals and p-values.
std::string ComparisonCsv(std::span<const DetectorComparison> comparisons);

/// A table for each part and sensor, with how to read it; empty without comparisons.
std::string ComparisonMarkdown(std::span<const DetectorComparison> comparisons);

}  // namespace fenestra
