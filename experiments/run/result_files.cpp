#include "experiments/run/result_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <ostream>

#include "core/io/input_error.h"
#include "core/io/system_error.h"
#include "core/io/temporary_files.h"
#include "experiments/analysis/cell_tally.h"
#include "experiments/report/provenance.h"
#include "experiments/report/report.h"
#include "experiments/report/row_reports.h"
#include "experiments/run/run_trials.h"
#include "experiments/trial_files/trial_files.h"

namespace fenestra {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTextFiles[] = {"study.yaml", "trials.csv", "summary.csv", "summary.md",
                                      "intervals.csv"};

std::string Get(const StoreMetadata& metadata, const std::string& key) {
  const auto found = metadata.find(key);
  return found == metadata.end() ? "" : found->second;
}

ReportTitle TitleOf(const ResultStore& store, const Study& study, const fs::path& file) {
  const StoreMetadata metadata = store.Metadata();
  ReportTitle title{.study = study.name,
                    .description = Get(metadata, "description"),
                    .provenance = {{"Fenestra", Get(metadata, "version")},
                                   {"Seed", std::to_string(study.seed)},
                                   {"Libraries", Get(metadata, "libraries")}}};
  if (const std::string part = PartStored(store, file); !part.empty()) {
    title.provenance.insert(title.provenance.begin(), {"Not whole", part});
  }
  if (const std::vector<RunEntry> runs = store.Runs(); !runs.empty()) {
    title.provenance.emplace_back("Processor", runs.back().processor);
    title.provenance.emplace_back("Jobs", std::to_string(runs.back().jobs));
  }
  const auto priors = PriorEntries(study);
  title.provenance.insert(title.provenance.end(), priors.begin(), priors.end());
  return title;
}

std::vector<std::string> TextFileNames() {
  std::vector<std::string> names(std::begin(kTextFiles), std::end(kTextFiles));
  names.insert(names.end(), kRowReportFiles.begin(), kRowReportFiles.end());
  return names;
}

// Of results without a record: the text files, and the folders that pictures of cells have.
std::vector<std::string> NamesToAdopt(const fs::path& folder) {
  std::vector<std::string> names = TextFileNames();
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "pictures", none)) {
    const std::string name = entry.path().filename();
    if (name.starts_with("cell_")) names.push_back("pictures/" + name);
  }
  return names;
}

// Sums up rows, of which those of a cell must agree about what it is.
class CheckedSummariser {
 public:
  CheckedSummariser(const fs::path& file, RowContext context)
      : file_(file), summariser_(std::move(context)) {}

  void Add(const TrialRecord& row) {
    if (!first_ || row.cell != first_->cell) first_ = row;
    if (row.part != first_->part || row.levels != first_->levels) {
      throw InputError(file_, fmt::format("the rows of cell {} are not of one cell", row.cell));
    }
    summariser_.Add(row);
  }
  std::vector<CellSummary> Finish() { return summariser_.Finish(); }

 private:
  fs::path file_;
  std::optional<TrialRecord> first_;  // Of its cell.
  Summariser summariser_;
};

}  // namespace

std::vector<CellSummary> Summarise(const ResultStore& store, RowContext context) {
  CheckedSummariser summariser(ResultStore::kFileName, std::move(context));
  store.ForEachRow([&summariser](const TrialRecord& row) { summariser.Add(row); });
  return summariser.Finish();
}

std::vector<CellSummary> WriteResultFiles(const ResultStore& store, const Study& study,
                                          std::span<const Cell> cells, const OutputPath& folder) {
  const fs::path file = folder.path() / ResultStore::kFileName;
  CheckedSummariser summariser(file, RowContext(study, cells));
  PooledMetrics pooled(study, cells, {.metrics = {"hit_rate", "false_alarm_rate"}});
  store.ForEachRow([&](const TrialRecord& row) {
    RequireTrialOf(cells, row, file);
    summariser.Add(row);
    pooled.Add(row);
  });
  std::vector<CellSummary> summaries = summariser.Finish();
  WriteFileAtomically(folder / "study.yaml", Get(store.Metadata(), "study"));
  WriteFileAtomically(folder / "trials.csv", [&store](std::ostream& out) {
    WriteTrialsCsv([&store](const auto& visit) { store.ForEachRow(visit); }, out);
  });
  WriteFileAtomically(folder / "summary.csv", SummaryCsv(summaries));
  WriteFileAtomically(folder / "intervals.csv", IntervalsCsv(summaries));
  RowReports reports(study, cells);
  store.ForEachRow([&reports](const TrialRecord& row) { reports.Add(row); });
  WriteFileAtomically(folder / "summary.md",
                      SummaryMarkdown(TitleOf(store, study, file), summaries, pooled.Groups()) +
                          reports.Markdown());
  WriteRowReports(reports, study, folder);
  return summaries;
}

bool HasResultFiles(const fs::path& folder) {
  for (const char* name : kTextFiles) {
    if (!fs::exists(folder / name)) return false;
  }
  return true;
}

OutputPath ResultsFolder(const fs::path& folder) {
  OutputPath results = OutputPath::Folder(folder);
  if (!results.HasRecord() && fs::exists(folder / ResultStore::kFileName)) {
    ResultStore::OpenReadOnly(folder / ResultStore::kFileName);  // Throws if it is none.
    results.Adopt(NamesToAdopt(folder));
  }
  results.RequireFree(TextFileNames());
  return results;
}

void RemoveResultFiles(const OutputPath& folder) {
  folder.RemoveOwn(TextFileNames());
  folder.RemoveOwn({"pictures"});
}

OutputPath PictureFolder(const OutputPath& folder, const Cell& cell) {
  return folder / "pictures" /
         fmt::format("cell_{:03}_{}_{}", cell.index, cell.part, ToString(cell.sensor));
}

void WriteResultPictures(const ResultStore& store, const Study& study, std::span<const Cell> cells,
                         const OutputPath& folder, int jobs,
                         std::shared_ptr<DetectorMaker> detectors) {
  std::vector<TrialKey> first;
  for (const TrialKey key : store.FinishedTrials()) {
    if (key.trial == 0) first.push_back(key);
  }
  const RunOptions options{.jobs = jobs,
                           .keep_artifacts = [](TrialKey) { return true; },
                           .detectors = std::move(detectors)};
  RunTrials(study, cells, first, options, [&](const FinishedTrial& trial) {
    WritePictures(PictureFolder(folder, trial.runner.cell()), trial);
  });
}

FolderLock::FolderLock(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::create_directories(folder, error)) made_ = folder;
  if (error) ThrowSystemFault(folder, "the folder cannot be made", error.value());
  descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) ThrowSystemFault(folder, "the folder cannot be read", errno);
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor_);
    throw InputError(folder, "another process is running a study into this folder");
  }
}

FolderLock::~FolderLock() {
  std::error_code not_empty;
  if (!made_.empty()) fs::remove(made_, not_empty);
  close(descriptor_);
}

uint64_t FolderSize(const std::filesystem::path& folder) {
  uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  return bytes;
}

}  // namespace fenestra
