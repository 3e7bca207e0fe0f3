#include "experiments/cli/print_result.h"

#include <fmt/format.h>

#include "experiments/report/provenance.h"
#include "experiments/report/report.h"
#include "experiments/study_file/study_reader.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {

void PrintResult(const std::vector<CellSummary>& summaries, const std::filesystem::path& folder) {
  fmt::print("{}", SummaryForTerminal(summaries));
  const Study study = ReadStudyFile(folder / "study.yaml", Detectors());
  for (const auto& [what, prior] : PriorEntries(study)) fmt::print("{}: {}\n", what, prior);
  fmt::print("\nTables and rows are in {}\n", folder.empty() ? "." : folder.string());
}

}  // namespace fenestra::cli
