#include "experiments/run/shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>

#include "core/io/faults.h"
#include "core/io/input_error.h"
#include "core/io/input_file.h"
#include "core/system/program.h"
#include "experiments/run/result_files.h"
#include "experiments/run/run_identity.h"
#include "experiments/run/run_trials.h"
#include "experiments/store/store.h"

namespace fenestra {
namespace fs = std::filesystem;
namespace {

constexpr int kMostShards = 100'000;

struct ShardResult {
  fs::path file;
  ResultStore store;
  StoreMetadata metadata;
  Shard shard;
};

std::vector<ShardResult> OpenAll(const std::vector<fs::path>& folders) {
  std::vector<ShardResult> shards;
  for (const fs::path& folder : folders) {
    const fs::path file = StoreFile(folder);
    ResultStore store = ResultStore::OpenReadOnly(file);
    StoreMetadata metadata = store.Metadata();
    const Shard shard = Shard::Parse(metadata.at("shard"));
    shards.push_back({file, std::move(store), std::move(metadata), shard});
  }
  return shards;
}

void Report(const ShardResult& shard, std::string message, Faults& faults) {
  faults.AddFault({.source = shard.file.string(), .message = std::move(message)});
}

void CheckIdentity(const std::vector<ShardResult>& shards) {
  Faults faults;
  const ShardResult& first = shards.front();
  for (const ShardResult& shard : shards) {
    std::vector<std::string> differences =
        Differences(IdentityFrom(first.metadata), IdentityFrom(shard.metadata));
    if (shard.shard.count != first.shard.count) {
      differences.push_back(
          fmt::format("shards: {} there, {} here", first.shard.count, shard.shard.count));
    }
    if (differences.empty()) continue;
    Report(shard,
           fmt::format("is of another result than {}. {}", first.file.string(),
                       fmt::join(differences, "; ")),
           faults);
  }
  faults.ThrowIfAny();
}

void CheckDivision(const std::vector<ShardResult>& shards) {
  Faults faults;
  std::map<int, const ShardResult*> by_index;
  for (const ShardResult& shard : shards) {
    const auto [other, fresh] = by_index.emplace(shard.shard.index, &shard);
    if (fresh) continue;
    Report(
        shard,
        fmt::format("is shard {}, as is {}", shard.shard.ToString(), other->second->file.string()),
        faults);
  }
  std::vector<std::string> missing;
  const int count = shards.front().shard.count;
  for (int index = 1; index <= count; ++index) {
    if (!by_index.contains(index)) missing.push_back(Shard{index, count}.ToString());
  }
  faults.Require(missing.empty(), fmt::format("missing: shard {}", fmt::join(missing, ", ")));
  faults.ThrowIfAny();
}

void CheckTrials(const std::vector<ShardResult>& shards, std::span<const TrialKey> all) {
  Faults faults;
  for (const ShardResult& shard : shards) {
    const std::vector<TrialKey> wanted = shard.shard.Of(all);
    const std::vector<TrialKey> found = shard.store.FinishedTrials();
    std::vector<TrialKey> missing;
    std::set_difference(wanted.begin(), wanted.end(), found.begin(), found.end(),
                        std::back_inserter(missing));
    if (!missing.empty()) {
      Report(shard,
             fmt::format("shard {} lacks {} of its {} trials, the first {}/{}; run it again, and "
                         "it goes on from where it ended",
                         shard.shard.ToString(), missing.size(), wanted.size(),
                         missing.front().cell, missing.front().trial),
             faults);
    } else if (found.size() > wanted.size()) {
      Report(shard, "has trials that are not its own", faults);
    }
  }
  faults.ThrowIfAny();
}

// Throws if `file` is the result of another study.
void CheckMayReplace(const fs::path& file, const ShardResult& shard) {
  if (!fs::exists(file)) return;
  const StoreMetadata there = ResultStore::OpenReadOnly(file).Metadata();
  std::vector<std::string> differences =
      Differences(IdentityFrom(there), IdentityFrom(shard.metadata));
  if (there.at("shard") != Shard{}.ToString()) {
    differences.push_back(fmt::format("it is shard {}", there.at("shard")));
  }
  if (differences.empty()) return;
  throw InputError(file, fmt::format("holds another result. {}. Choose another --out, or replace "
                                     "it with --restart",
                                     fmt::join(differences, "; ")));
}

void CopyRows(const ShardResult& shard, ResultStore& joined) {
  constexpr size_t kTogether = 1000;
  std::vector<std::vector<TrialRecord>> trials;
  shard.store.ForEachRow([&](const TrialRecord& row) {
    const bool same = !trials.empty() && trials.back().front().cell == row.cell &&
                      trials.back().front().trial == row.trial;
    if (!same && trials.size() == kTogether) {
      joined.AddTrials(trials);
      trials.clear();
    }
    if (!same) trials.emplace_back();
    trials.back().push_back(row);
  });
  joined.AddTrials(trials);
  for (const RunEntry& run : shard.store.Runs()) joined.AddRun(run);
}

void JoinStores(const std::vector<ShardResult>& shards, const fs::path& file) {
  const fs::path growing = file.string() + ".merging";
  fs::remove(growing);  // Left by a merge that was killed.
  StoreMetadata metadata = shards.front().metadata;
  metadata["shard"] = Shard{}.ToString();
  {
    ResultStore joined = ResultStore::Create(growing, metadata);
    for (const ShardResult& shard : shards) CopyRows(shard, joined);
  }
  fs::rename(growing, file);
}

void CopyPictures(const std::vector<ShardResult>& shards, const OutputPath& out) {
  for (const ShardResult& shard : shards) {
    const fs::path pictures = shard.file.parent_path() / "pictures";
    if (!fs::is_directory(pictures)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(pictures)) {
      if (!entry.is_regular_file()) continue;
      WriteFileAtomically(out / "pictures" / entry.path().lexically_relative(pictures),
                          [&entry](std::ostream& to) {
                            to << OpenInput(entry.path()).rdbuf();
                          });
    }
  }
}

// Of a folder in sbatch's --output, where % begins a pattern.
std::string WithoutPatterns(const std::string& folder) {
  std::string literal;
  for (const char c : folder) literal += c == '%' ? "%%" : std::string(1, c);
  return literal;
}

// sbatch reads quotes in its directives as a shell does.
std::string Header(const SlurmSubmission& submission, const std::string& log) {
  std::string text = fmt::format(
      "#!/bin/bash\n"
      "#SBATCH --job-name=fenestra-{}\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --output={}\n",
      submission.name,
      ShellQuoted(WithoutPatterns((submission.out / "slurm").string()) + "/" + log));
  for (const std::string& option : submission.sbatch_options) {
    text += fmt::format("#SBATCH {}\n", option);
  }
  return text;
}

std::string PluginOptions(const SlurmSubmission& submission) {
  std::string options;
  for (const std::filesystem::path& plugin : submission.plugins) {
    options += " --plugin " + ShellQuoted(plugin.string());
  }
  return options;
}

}  // namespace

std::string Shard::ToString() const {
  return fmt::format("{}/{}", index, count);
}

Shard Shard::Parse(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  if (index.ec == std::errc() && index.ptr != end && *index.ptr == '/') {
    const auto count = std::from_chars(index.ptr + 1, end, shard.count);
    const bool whole = count.ec == std::errc() && count.ptr == end;
    if (whole && shard.count >= 1 && shard.count <= kMostShards && shard.index >= 1 &&
        shard.index <= shard.count) {
      return shard;
    }
  }
  throw InputError("--shard", fmt::format("must be I/N with I from 1 to N and N up to {}, such as "
                                          "2/8, not '{}'",
                                          kMostShards, text));
}

std::vector<TrialKey> Shard::Of(std::span<const TrialKey> all) const {
  std::vector<TrialKey> share;
  const auto stride = static_cast<size_t>(count);
  share.reserve(all.size() / stride + 1);
  for (size_t i = static_cast<size_t>(index - 1); i < all.size(); i += stride) {
    share.push_back(all[i]);
  }
  return share;
}

std::vector<CellSummary> MergeShards(const Merge& merge) {
  if (merge.shards.empty()) throw InputError("", "there are no shards to merge");
  const std::vector<ShardResult> shards = OpenAll(merge.shards);
  CheckIdentity(shards);
  CheckDivision(shards);
  const Study study = StudyOf(shards.front().store, shards.front().file);
  const std::vector<Cell> cells = Cells(study);
  CheckTrials(shards, AllTrials(cells));
  const FolderLock lock(merge.out);
  const OutputPath out = ResultsFolder(merge.out);
  const fs::path file = merge.out / ResultStore::kFileName;
  for (const ShardResult& shard : shards) {
    if (fs::exists(file) && fs::equivalent(file, shard.file)) {
      throw InputError(merge.out, "is the folder of a shard; choose another --out");
    }
  }
  if (!merge.restart) CheckMayReplace(file, shards.front());
  try {
    out.StartRecord();
    JoinStores(shards, file);
    RemoveResultFiles(out);
    CopyPictures(shards, out);
  } catch (const fs::filesystem_error& error) {
    throw InputError(merge.out, error.what());
  }
  return WriteResultFiles(ResultStore::OpenReadOnly(file), study, cells, out);
}

std::string SlurmArrayScript(const SlurmSubmission& submission) {
  std::string text = Header(submission, "shard-%a.log");
  text += fmt::format("#SBATCH --array=1-{}\n#SBATCH --cpus-per-task={}\n", submission.shards,
                      submission.jobs);
  std::string options = PluginOptions(submission);
  for (const std::string& option : submission.run_options) options += " " + ShellQuoted(option);
  return text + fmt::format(
                    "exec {} run {}{} --jobs {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" "
                    "--out {}/\"$SLURM_ARRAY_TASK_ID\"\n",
                    ShellQuoted(submission.program.string()),
                    ShellQuoted(submission.study.string()), options, submission.jobs,
                    submission.shards, ShellQuoted((submission.out / "shards").string()));
}

std::string SlurmMergeScript(const SlurmSubmission& submission) {
  return Header(submission, "merge.log") +
         fmt::format("exec {} merge {}/{{1..{}}} --out {}{}\n",
                     ShellQuoted(submission.program.string()),
                     ShellQuoted((submission.out / "shards").string()), submission.shards,
                     ShellQuoted(submission.out.string()), PluginOptions(submission));
}

}  // namespace fenestra
