#include "experiments/run/stored_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/io/input_error.h"
#include "experiments/analysis/trial_plan.h"
#include "experiments/run/run_trials.h"
#include "experiments/study_file/study_reader.h"
#include "vision/detector_registry.h"

namespace fenestra {

namespace fs = std::filesystem;

fs::path StoreFile(const fs::path& results) {
  return fs::is_directory(results) ? results / ResultStore::kFileName : results;
}

Study StudyOf(const ResultStore& store, const fs::path& file) {
  if (!store.Metadata().contains("study")) {
    throw InputError(file, "holds no study: a recorded sequence is scored again");
  }
  return ReadStudy(YamlReader::FromText(store.Metadata().at("study"), file.string() + " (study)"),
                   Detectors());
}

RowContext ContextOf(const ResultStore& store, const fs::path& file) {
  if (!store.Metadata().contains("study")) return RowContext();
  const Study study = StudyOf(store, file);
  return RowContext(study, Cells(study));
}

void RequireTrialOf(std::span<const Cell> cells, const TrialRecord& row, const fs::path& file) {
  const auto cell = static_cast<size_t>(row.cell);
  if (cell < cells.size() && row.trial < cells[cell].repetitions) return;
  throw InputError(file, fmt::format("has a row of trial {} of cell {}, which its study has not",
                                     row.trial, row.cell));
}

bool IsAdaptive(const Study& study) {
  return std::any_of(study.parts.begin(), study.parts.end(),
                     [](const StudyPart& part) { return part.until || part.envelope; });
}

std::vector<TrialKey> MissingTrials(const Study& study, std::span<const Cell> cells,
                                    std::span<const TrialKey> wanted, const ResultStore& store,
                                    const std::filesystem::path& file) {
  if (!IsAdaptive(study)) {
    const std::vector<TrialKey> stored = store.FinishedTrials();
    std::vector<TrialKey> missing;
    std::set_difference(wanted.begin(), wanted.end(), stored.begin(), stored.end(),
                        std::back_inserter(missing));
    return missing;
  }
  TrialPlan plan(study, cells);
  store.ForEachRow([&](const TrialRecord& row) {
    RequireTrialOf(cells, row, file);
    plan.Add(row);
  });
  return plan.Next();
}

std::string PartStored(const ResultStore& store, const std::filesystem::path& file) {
  if (!store.Metadata().contains("study")) return "";
  const Study study = StudyOf(store, file);
  const std::vector<Cell> cells = Cells(study);
  const size_t missing = MissingTrials(study, cells, AllTrials(cells), store, file).size();
  if (missing == 0) return "";
  const size_t stored = store.FinishedTrials().size();
  return IsAdaptive(study) ? fmt::format("{} of at least {} trials", stored, stored + missing)
                           : fmt::format("{} of {} trials", stored, stored + missing);
}

}  // namespace fenestra
