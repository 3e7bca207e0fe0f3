#include <fmt/format.h>

#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/study/factors.h"
#include "experiments/study/metric.h"
#include "experiments/study_file/study_catalogue.h"
#include "experiments/study_file/study_reader.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

// Without the last digits that a unit's conversion leaves: 15, not 14.999999999999998.
std::string Written(const ParameterValue& value) {
  const double* number = std::get_if<double>(&value);
  return number != nullptr ? fmt::format("{:.12g}", *number) : ToString(value);
}

void PrintParameters(const std::vector<ParameterInfo>& infos, const std::string& indent) {
  size_t name_width = 0;
  size_t default_width = 0;
  for (const ParameterInfo& info : infos) {
    name_width = std::max(name_width, info.name.size());
    default_width = std::max(default_width, Written(info.default_value).size());
  }
  for (const ParameterInfo& info : infos) {
    fmt::print("{}{:<{}}  {:>{}}  {} ({})\n", indent, info.name, name_width,
               Written(info.default_value), default_width, info.description, info.Allowed());
  }
}

void ListDetectors() {
  for (const DetectorInfo& detector : Detectors()) {
    fmt::print("{} ({}): {}\n", detector.name, ToString(detector.sensor), detector.description);
    PrintParameters(detector.options, "    ");
  }
}

void ListStudies() {
  for (const std::string& name : BuiltInStudies()) {
    const Study study = ReadStudyFile(FindStudy(name), Detectors());
    fmt::print("{:<12} {}\n", name, study.description);
  }
}

void ListMetrics() {
  for (const NamedMetric& metric : Metrics()) {
    fmt::print("{:<30} of {}\n", metric.name, ToString(RowsOf(metric.metric)));
  }
}

}  // namespace

void AddListCommand(Command program) {
  Command list = program.AddCommand("list", "Shows detectors, factors, metrics or studies");
  list.Footer(
      "Example:\n"
      "  fenestra list factors | grep window");
  list.RequireCommand();
  Command detectors = list.AddCommand("detectors", "All detectors and their options with defaults");
  const auto plugins = std::make_shared<std::vector<std::filesystem::path>>();
  AddPluginOption(detectors, *plugins);
  detectors.Action([plugins] {
    LoadPlugins(*plugins);
    ListDetectors();
    return kDone;
  });
  list.AddCommand("factors", "All that a study can vary, with defaults").Action([] {
    PrintParameters(Factors().infos(), "");
    return kDone;
  });
  list.AddCommand("metrics", "All that is told of rows, with what each is taken over").Action([] {
    ListMetrics();
    return kDone;
  });
  list.AddCommand("studies", "The studies that come with the program").Action([] {
    ListStudies();
    return kDone;
  });
}

}  // namespace fenestra::cli
