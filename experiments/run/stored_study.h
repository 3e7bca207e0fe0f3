#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/row_context.h"
#include "experiments/store/store.h"
#include "experiments/study/study.h"

namespace fenestra {

/// results.sqlite in a results folder; a path that is not a folder is taken for the file itself.
std::filesystem::path StoreFile(const std::filesystem::path& results);

/// The resolved study of a store. Throws InputError if this program cannot read it.
Study StudyOf(const ResultStore& store, const std::filesystem::path& file);

/// What a store's study says of its rows; of a recorded sequence, that each is independent.
RowContext ContextOf(const ResultStore& store, const std::filesystem::path& file);

/// Throws InputError if the study has no such trial.
void RequireTrialOf(std::span<const Cell> cells, const TrialRecord& row,
                    const std::filesystem::path& file);

/// Whether what is there decides which trials of a study are run: it has `until` or `envelope`.
bool IsAdaptive(const Study& study);

/// Those of the trials `wanted` that the store lacks, in their order. Of an adaptive study, those
/// that the rows call for next. Throws InputError for a row of a trial
/// that the study has not.
std::vector<TrialKey> MissingTrials(const Study& study, std::span<const Cell> cells,
                                    std::span<const TrialKey> wanted, const ResultStore& store,
                                    const std::filesystem::path& file);

/// Empty for a store with all trials of its study, and for that of a recorded sequence. Otherwise
/// how much is there, as after an interrupted run or of a shard: "11 of 80 trials".
std::string PartStored(const ResultStore& store, const std::filesystem::path& file);

}  // namespace fenestra
