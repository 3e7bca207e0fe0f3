#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/study.h"
#include "experiments/summary.h"

namespace fenestra {

/// A run of a whole study into a results folder:
///
///     results.sqlite   every row, written as trials finish (ResultStore)
///     study.yaml       the study with nothing left to defaults
///     trials.csv       every row
///     summary.csv      one line per cell and detector
///     summary.md       the report
///     pictures/        of the first trial of each cell, see WritePictures
///
/// An older result in the folder is replaced; a folder with another program's results.sqlite is
/// refused with InputError. Files that a person put there stay.
struct StudyRun {
  Study study;
  std::string study_text;  ///< As written by the user.
  std::filesystem::path out;
  int jobs = 1;
  /// Called after each trial, from several threads.
  std::function<void()> on_trial = [] {};
};

std::vector<CellSummary> RunStudy(const StudyRun& run);

/// Keys of the store's metadata.
inline constexpr const char* kMetaStudy = "study";
inline constexpr const char* kMetaStudyText = "study_text";

}  // namespace fenestra
