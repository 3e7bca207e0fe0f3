#include <fmt/format.h>

#include <filesystem>

#include "core/io/temporary_files.h"
#include "experiments/report/report.h"
#include "experiments/run/folder_size.h"
#include "experiments/run/run_trials.h"
#include "experiments/run/study_explanation.h"
#include "experiments/store/store.h"
#include "experiments/trial/cell_runner.h"
#include "experiments/trial_files/trial_files.h"

namespace fenestra {
namespace fs = std::filesystem;
namespace {

// A store grows by whole pages, so a single trial would tell nothing.
double StoredBytes(std::vector<TrialRecord> rows, const fs::path& folder) {
  constexpr int kCopies = 100;
  const fs::path file = folder / "rows.sqlite";
  ResultStore store = ResultStore::Create(file, {});
  const auto empty = static_cast<double>(fs::file_size(file));
  for (int copy = 0; copy < kCopies; ++copy) {
    for (TrialRecord& row : rows) row.trial = copy;
    store.AddTrial(rows);
  }
  return (static_cast<double>(fs::file_size(file)) - empty) / kCopies;
}

double CsvBytes(const std::vector<TrialRecord>& rows) {
  return static_cast<double>(TrialsCsv(rows).size() - TrialsCsv({}).size());
}

}  // namespace

TrialCost MeasureCost(const Study& study, const Cell& cell, int trials,
                      const std::shared_ptr<DetectorMaker>& detectors) {
  TrialCost cost;
  const Clock clock = SteadyClock();
  const double start_s = clock();
  const CellRunner runner(study, cell, detectors);
  const double ready_s = clock();
  cost.cell_s = ready_s - start_s;
  for (int trial = 0; trial < trials; ++trial) {
    const SimulatedTrial simulated = runner.Simulate(trial);
    for (size_t i = 0; i < runner.detectors().size(); ++i) runner.Try(i, simulated, false);
  }
  cost.trial_s = (clock() - ready_s) / trials;

  const SimulatedTrial simulated = runner.Simulate(0);
  std::vector<Attempt> attempts;
  for (size_t i = 0; i < runner.detectors().size(); ++i) {
    attempts.push_back(runner.Try(i, simulated, true));
  }
  const FinishedTrial finished{runner, simulated, attempts};
  const PrivateFolder scratch;
  WritePictures(scratch.path() / "pictures", finished);
  cost.picture_bytes = static_cast<double>(FolderSize(scratch.path() / "pictures"));
  cost.row_bytes = StoredBytes(finished.Records(), scratch.path()) + CsvBytes(finished.Records());
  return cost;
}

}  // namespace fenestra
