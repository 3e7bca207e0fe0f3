#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "core/io/output_path.h"
#include "experiments/analysis/cell_summary.h"
#include "experiments/analysis/row_context.h"
#include "experiments/run/stored_study.h"
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

/// Summaries of all rows; holds the numbers of one cell at a time. Without a context every row is
/// taken for independent.
std::vector<CellSummary> Summarise(const ResultStore& store, RowContext context = {});

/// Writes all but the pictures. `study` is the store's, `cells` are all of its cells.
std::vector<CellSummary> WriteResultFiles(const ResultStore& store, const Study& study,
                                          std::span<const Cell> cells, const OutputPath& folder);
/// Whether they are all there.
bool HasResultFiles(const std::filesystem::path& folder);

/// A folder for results. Throws InputError where a file is in the way that this program has not
/// written. Results of versions that kept no record of their files are known by their store.
OutputPath ResultsFolder(const std::filesystem::path& folder);
/// Deletes them and the pictures: they belong to a result that is about to be replaced.
void RemoveResultFiles(const OutputPath& folder);

/// Where the pictures of a cell belong.
OutputPath PictureFolder(const OutputPath& folder, const Cell& cell);

/// Makes the pictures again by running the first trial of every cell that the store has.
void WriteResultPictures(const ResultStore& store, const Study& study, std::span<const Cell> cells,
                         const OutputPath& folder, int jobs,
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
  std::filesystem::path made_;  ///< The folder, if it was missing; it goes again if it stays empty.
  int descriptor_ = -1;
};

/// The size of all files in the folder and below it [bytes].
uint64_t FolderSize(const std::filesystem::path& folder);

}  // namespace fenestra
