#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "experiments/analysis/cell_summary.h"
#include "experiments/analysis/row_context.h"
#include "experiments/store/store.h"
#include "experiments/study/study.h"
#include "experiments/trial/detector_maker.h"

namespace fenestra {

/// The files of a results folder:
///
///     results.sqlite   every row, written as trials finish (ResultStore); the rest follows from it
///     study.yaml       the study with nothing left to defaults
///     trials.csv       every row
///     summary.csv      one line per cell and detector
///     summary.md       the report
///     intervals.csv    every figure of a cell and detector with its interval
///     comparison.csv, error_budget.csv, envelope.csv, envelope.png     where there are any
///     pictures/        of the first trial of each cell, see WritePictures
///
/// docs/results.md describes them to users.

/// results.sqlite in a results folder; a path that is not a folder is taken for the file itself.
std::filesystem::path StoreFile(const std::filesystem::path& results);

/// The resolved study of a store. Throws InputError if this program cannot read it.
Study StudyOf(const ResultStore& store, const std::filesystem::path& file);

/// What a store's study says of its rows; of a recorded sequence, that each is independent.
RowContext ContextOf(const ResultStore& store, const std::filesystem::path& file);

/// Throws InputError if the study has no such trial.
void RequireTrialOf(std::span<const Cell> cells, const TrialRecord& row,
                    const std::filesystem::path& file);

/// Summaries of all rows; holds the numbers of one cell at a time. Without a context every row is
/// taken for independent.
std::vector<CellSummary> Summarise(const ResultStore& store, RowContext context = {});

/// Writes all but the pictures. `study` is the store's, `cells` are all of its cells.
std::vector<CellSummary> WriteResultFiles(const ResultStore& store, const Study& study,
                                          std::span<const Cell> cells,
                                          const std::filesystem::path& folder);
/// Whether they are all there.
bool HasResultFiles(const std::filesystem::path& folder);
/// Deletes them and the pictures: they belong to a result that is about to be replaced.
void RemoveResultFiles(const std::filesystem::path& folder);

/// Where the pictures of a cell belong.
std::filesystem::path PictureFolder(const std::filesystem::path& folder, const Cell& cell);

/// Makes the pictures again by running the first trial of every cell that the store has.
void WriteResultPictures(const ResultStore& store, const Study& study, std::span<const Cell> cells,
                         const std::filesystem::path& folder, int jobs,
                         std::shared_ptr<DetectorMaker> detectors);

/// Keeps two processes from running into the same results folder. Held while it lives; released by
/// the system if the process is killed. On file systems that cannot lock a folder it does nothing.
class FolderLock {
 public:
  /// Makes the folder if it is missing. Throws InputError if that fails or if another process holds
  /// the lock.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// The size of all files in the folder and below it [bytes].
uint64_t FolderSize(const std::filesystem::path& folder);

}  // namespace fenestra
