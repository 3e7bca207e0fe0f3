#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "experiments/analysis/cell_summary.h"

namespace fenestra {

struct Merge {
  std::vector<std::filesystem::path> shards;  ///< Results folders or their results.sqlite.
  std::filesystem::path out;
  bool restart = false;  ///< Replace another result in `out`.
};

/// Joins the shards of a study into one result: rows, tables and pictures are, times apart, those
/// of a single run, bit for bit.
///
/// Throws InputError, with every fault at once, unless the shards are of the same result
/// (RunIdentity) and of the same division, none is missing, none is there twice, and each has all
/// of its trials and no others. A result in `out` is replaced only if it is of the same study, as
/// when a merge is repeated, or if `restart` is set. The joined store appears by rename.
std::vector<CellSummary> MergeShards(const Merge& merge);

}  // namespace fenestra
