#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <span>

#include "core/io/faults.h"
#include "core/io/input_error.h"
#include "experiments/check/limit_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/study_run_arguments.h"
#include "experiments/report/pooled_report.h"
#include "experiments/run/result_files.h"
#include "experiments/store/store.h"

namespace fenestra::cli {
namespace {

struct PoolArguments {
  std::filesystem::path results;
  std::vector<std::string> by;
  std::string where;
  std::vector<std::string> metrics;
  bool csv = false;
};

void CheckMetrics(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const NamedMetric& metric : Metrics()) known.push_back(metric.name);
  for (const std::string& name : names) {
    if (FindMetric(name)) continue;
    throw InputError("--metrics",
                     fmt::format("there is no metric '{}'.{}", name, DidYouMean(name, known)));
  }
}

std::vector<Condition> ConditionsOf(const Study& study, std::span<const Cell> cells,
                                    const std::string& where) {
  if (where.empty()) return {};
  try {
    std::vector<Condition> conditions = ParseConditions(where);
    const std::vector<std::string> objections = RowSelection(study, cells).Objections(conditions);
    if (!objections.empty()) throw InputError("--where", objections.front());
    return conditions;
  } catch (const LimitTextError& error) {
    throw InputError("--where", fmt::format("this condition {}", error.what()));
  }
}

int Pool(const PoolArguments& arguments) {
  CheckMetrics(arguments.metrics);
  const std::filesystem::path file = StoreFile(arguments.results);
  const ResultStore store = ResultStore::OpenReadOnly(file);
  NoteMissingTrials(store, file);
  const Study study = StudyOf(store, file);
  const std::vector<Cell> cells = Cells(study);
  Pooling pooling{.where = ConditionsOf(study, cells, arguments.where)};
  if (!arguments.by.empty()) pooling.by = arguments.by;
  const std::vector<std::string> by = pooling.by;
  std::vector<std::string> shown = arguments.metrics;
  if (shown.empty() && !arguments.csv) {
    shown = {"hit_rate", "false_alarm_rate", "rmse_mm", "p50_error_mm", "p95_error_mm"};
  }
  pooling.metrics = shown;
  PooledMetrics pooled(study, cells, std::move(pooling));
  store.ForEachRow([&](const TrialRecord& row) {
    RequireTrialOf(cells, row, file);
    pooled.Add(row);
  });
  const std::vector<PooledGroup> groups = pooled.Groups();
  fmt::print("{}", arguments.csv ? PooledCsv(by, groups) : PooledTable(by, groups, shown));
  return kDone;
}

}  // namespace

void AddPoolCommand(Command program) {
  Command command = program.AddCommand(
      "pool", "Takes cells of a result together, with intervals that know what cells share");
  command.Footer(
      "Example:\n"
      "  fenestra pool results/paper --by distance_m,detector --where \"distance_m <= 4\"\n"
      "Cells share the random numbers of their trials unless the study says otherwise: the trials "
      "of\n"
      "one number count as one witness. `fenestra list metrics` names all metrics.");
  const auto arguments = std::make_shared<PoolArguments>();
  command.AddOption("RESULTS", arguments->results, "Results folder or its results.sqlite")
      .Required();
  command
      .AddOption("--by", arguments->by,
                 "Factors, part, sensor or detector that rows of one group agree in; default: "
                 "part,sensor,detector")
      .Delimiter(',');
  command.AddOption("--where", arguments->where,
                    "Which rows, as in a check: \"detector = edge-stereo and distance_m <= 3\"");
  command
      .AddOption("--metrics", arguments->metrics,
                 "Metrics by name; default: rates, RMSE and quantiles of the error, with --csv all")
      .Delimiter(',');
  command.AddFlag("--csv", arguments->csv, "Prints CSV, one line for each group and metric");
  command.Action([arguments] { return Pool(*arguments); });
}

}  // namespace fenestra::cli
