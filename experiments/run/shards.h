#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/cell_summary.h"
#include "experiments/trial/trial_record.h"

namespace fenestra {

/// A share of a study's trials, for one of several machines: of all trials in order, every
/// count-th one, beginning with number `index`. Shares differ by one trial at most, and each has
/// its part of every cell, however long a cell's trials take.
struct Shard {
  int index = 1;  ///< 1 to count.
  int count = 1;

  /// "2/8".
  std::string ToString() const;
  /// Throws InputError, as an error of the option --shard, for any other text.
  static Shard Parse(const std::string& text);

  /// The share of `all`, in their order.
  std::vector<TrialKey> Of(std::span<const TrialKey> all) const;

  bool operator==(const Shard&) const = default;
};

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
