#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "experiments/analysis/paired_ratio.h"
#include "experiments/cli/commands.h"
#include "experiments/report/paired_ratio_report.h"
#include "experiments/run/result_files.h"
#include "experiments/store/store.h"

namespace fenestra::cli {

void AddRatiosCommand(Command program) {
  Command command = program.AddCommand(
      "ratios", "Compares the levels of one factor in a study's results, trial by trial");
  command.Footer(
      "Example:\n"
      "  fenestra ratios results/depth_models --factor rgbd_depth_model\n"
      "RMSE and P95 of the centroid error under each level over those under the first one, with 90 "
      "%\n"
      "bootstrap intervals: trials of one index have the same poses under all levels.");
  const auto results = std::make_shared<std::filesystem::path>();
  const auto factor = std::make_shared<std::string>();
  command.AddOption("RESULTS", *results, "Results folder or its results.sqlite").Required();
  command.AddOption("--factor", *factor, "A factor with levels").Required();
  command.Action([results, factor] {
    const std::vector<TrialRecord> rows = ResultStore::OpenReadOnly(StoreFile(*results)).Rows();
    fmt::print("{}", PairedRatioTable(PairsBy(rows, *factor), *factor, RandomStream(1)));
    return kDone;
  });
}

}  // namespace fenestra::cli
