#include "experiments/run/replay.h"

#include <fmt/format.h>

#include <bit>

#include "core/io/input_error.h"
#include "experiments/run/result_files.h"
#include "experiments/run/run_trials.h"
#include "experiments/store/store.h"
#include "experiments/trial_files/trial_files.h"

namespace fenestra {
namespace {

using Numbers = std::vector<double>;

void Append(Numbers& numbers, const Eigen::Vector3d& v) {
  numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
}

Numbers NumbersOf(const std::optional<WindowEstimate>& estimate) {
  Numbers numbers;
  if (!estimate) return numbers;
  Append(numbers, estimate->p_CO);
  for (const Eigen::Vector3d& p_CV : estimate->p_CV) Append(numbers, p_CV);
  Append(numbers, estimate->normal_C);
  if (estimate->covariance_C) {
    for (int i = 0; i < 3; ++i) Append(numbers, estimate->covariance_C->col(i));
  }
  return numbers;
}

bool SameBits(const Numbers& a, const Numbers& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y);
  });
}

std::vector<std::string> Differences(const TrialRecord& recorded, const TrialRecord& repeated) {
  std::vector<std::string> differences;
  const auto compare = [&differences](const char* what, const auto& a, const auto& b) {
    if (a != b) differences.push_back(fmt::format("{}: recorded '{}', now '{}'", what, a, b));
  };
  compare("outcome", std::string(ToString(recorded.score.outcome)),
          std::string(ToString(repeated.score.outcome)));
  compare("reason", recorded.score.reason, repeated.score.reason);
  compare("detail", recorded.score.detail, repeated.score.detail);
  if (recorded.drawn != repeated.drawn) differences.push_back("drawn factors differ");
  if (recorded.score.truth_p_CO != repeated.score.truth_p_CO)
    differences.push_back("truth differs");
  const Numbers a = NumbersOf(recorded.score.estimate);
  const Numbers b = NumbersOf(repeated.score.estimate);
  if (!SameBits(a, b)) {
    differences.push_back(
        fmt::format("estimate: recorded [{}], now [{}]", fmt::join(a, ", "), fmt::join(b, ", ")));
  }
  return differences;
}

}  // namespace

std::vector<ReplayedRow> Replay(const std::filesystem::path& results, int cell, int trial,
                                const std::filesystem::path& out,
                                std::shared_ptr<DetectorMaker> detectors) {
  const std::filesystem::path file = StoreFile(results);
  const ResultStore store = ResultStore::OpenReadOnly(file);
  std::vector<ReplayedRow> rows;
  for (const TrialRecord& record : store.RowsOf({cell, trial})) rows.push_back({record, {}, {}});
  if (rows.empty()) {
    throw InputError(file, fmt::format("holds no trial {}/{} (cell/trial)", cell, trial));
  }

  const OutputPath folder = OutputPath::Folder(out);
  const Study study = StudyOf(store, file);
  const std::vector<Cell> cells = Cells(study);
  const std::vector<TrialKey> trials = {{cell, trial}};
  const RunOptions options{.jobs = 1,
                           .keep_artifacts = [&](TrialKey) { return !out.empty(); },
                           .detectors = std::move(detectors)};
  RunTrials(study, cells, trials, options, [&](const FinishedTrial& finished) {
    for (const TrialRecord& repeated : finished.Records()) {
      for (ReplayedRow& row : rows) {
        if (row.recorded.detector == repeated.detector) row.repeated = repeated;
      }
    }
    if (out.empty()) return;
    WritePictures(folder / "pictures", finished);
    WriteTrialFiles(folder, finished.runner, finished.simulated);
  });
  const StoreMetadata metadata = store.Metadata();
  for (ReplayedRow& row : rows) {
    row.differences = Differences(row.recorded, row.repeated);
    if (row.differences.empty() || row.repeated.score.reason != "start") continue;
    if (const auto started_in = metadata.find("started_in"); started_in != metadata.end()) {
      row.differences.push_back(
          fmt::format("folder from which the detector is started: recorded '{}', now '{}'",
                      started_in->second, std::filesystem::current_path().string()));
    }
  }
  return rows;
}

}  // namespace fenestra
