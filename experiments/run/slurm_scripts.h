#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fenestra {

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
