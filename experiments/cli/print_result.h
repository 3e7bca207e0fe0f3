#pragma once

#include <filesystem>
#include <vector>

#include "experiments/analysis/cell_summary.h"

namespace fenestra::cli {

/// The tables of a result, what its detectors were told beforehand, and where its files are.
void PrintResult(const std::vector<CellSummary>& summaries, const std::filesystem::path& folder);

}  // namespace fenestra::cli
