#include "experiments/run_study.h"

#include <fmt/format.h>

#include "core/atomic_file.h"
#include "experiments/prior_text.h"
#include "experiments/report.h"
#include "experiments/run_trials.h"
#include "experiments/store.h"
#include "experiments/study_writer.h"
#include "experiments/trial_files.h"
#include "experiments/versions.h"

namespace fenestra {
namespace {

StoreMetadata MetadataOf(const StudyRun& run) {
  return {{kMetaStudy, ToYaml(run.study)}, {kMetaStudyText, run.study_text},
          {"name", run.study.name},        {"seed", std::to_string(run.study.seed)},
          {"version", Version()},          {"libraries", LibraryVersions()},
          {"processor", Processor()},      {"jobs", std::to_string(run.jobs)}};
}

std::filesystem::path PictureFolder(const StudyRun& run, const Cell& cell) {
  return run.out / "pictures" /
         fmt::format("cell_{:03}_{}_{}", cell.index, cell.part, ToString(cell.sensor));
}

void WriteReports(const StudyRun& run, const std::vector<TrialRecord>& records,
                  const std::vector<CellSummary>& summaries) {
  ReportTitle title{.study = run.study.name,
                    .description = run.study.description,
                    .provenance = {{"Fenestra", Version()},
                                   {"Seed", std::to_string(run.study.seed)},
                                   {"Libraries", LibraryVersions()},
                                   {"Processor", Processor()},
                                   {"Jobs", std::to_string(run.jobs)}}};
  const auto priors = PriorEntries(run.study);
  title.provenance.insert(title.provenance.end(), priors.begin(), priors.end());
  WriteFileAtomically(run.out / "trials.csv", TrialsCsv(records));
  WriteFileAtomically(run.out / "summary.csv", SummaryCsv(summaries));
  WriteFileAtomically(run.out / "summary.md", SummaryMarkdown(title, summaries));
}

}  // namespace

std::vector<CellSummary> RunStudy(const StudyRun& run) {
  const std::vector<Cell> cells = Cells(run.study);
  const std::vector<TrialKey> trials = AllTrials(cells);

  ResultStore store = ResultStore::Create(run.out / "results.sqlite", MetadataOf(run),
                                          ResultStore::IfExists::kReplace);
  std::filesystem::remove_all(run.out / "pictures");  // Of an older run.
  WriteFileAtomically(run.out / "study.yaml", ToYaml(run.study));

  const RunOptions options{.jobs = run.jobs,
                           .keep_artifacts = [](TrialKey key) { return key.trial == 0; }};
  RunTrials(run.study, cells, trials, options, [&](const FinishedTrial& trial) {
    const TrialKey key = trial.key();
    if (key.trial == 0) {
      WritePictures(PictureFolder(run, cells[static_cast<size_t>(key.cell)]), trial);
    }
    store.AddTrial(trial.Records());
    run.on_trial();
  });

  const std::vector<TrialRecord> records = store.Rows();
  std::vector<CellSummary> summaries = Summarise(records);
  WriteReports(run, records, summaries);
  return summaries;
}

}  // namespace fenestra
