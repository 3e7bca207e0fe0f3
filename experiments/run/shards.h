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

/// A study shared out over a Slurm cluster.
struct SlurmSubmission {
  std::filesystem::path program;                    ///< This program, as all nodes see it.
  std::filesystem::path study;                      ///< The study's file, as all nodes see it.
  std::string name;                                 ///< The study's name.
  std::vector<std::string> run_options;             ///< Further options of `fenestra run`.
  std::vector<std::filesystem::path> plugins = {};  ///< As all nodes see them.
  std::vector<std::string> sbatch_options;  ///< Further options of sbatch, such as --time=1:00:00.
  std::filesystem::path out;                ///< Absolute; shards go to `out`/shards/1 and so on.
  int shards = 1;
  int jobs = 1;  ///< Processors of each shard.
};

/// The script of the job array, one task per shard. A task that is requeued, because its node
/// failed or another job came first, goes on from what it has stored.
std::string SlurmArrayScript(const SlurmSubmission& submission);

/// The script of the job that merges the shards when all of them are done.
std::string SlurmMergeScript(const SlurmSubmission& submission);

}  // namespace fenestra
