#include "experiments/report/pooled_report.h"

#include <fmt/format.h>

#include "experiments/output/file_formats.h"
#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"

namespace fenestra {
namespace {

std::string TextOf(const std::optional<ParameterValue>& value) {
  return value ? ToString(*value) : "";
}

// "95.0 % (90.0–97.9 %) of 80", "1.23 (1.11 to 1.38) of 76".
std::string CellText(const std::string& name, const MetricEstimate* estimate) {
  if (estimate == nullptr) return kAbsent;
  const bool is_share = FindMetric(name)->IsShare();
  std::string text = is_share ? Percent(estimate->value) : Significant(estimate->value);
  if (const auto& interval = estimate->interval) {
    text += is_share ? fmt::format(" ({})", Percent(*interval))
                     : fmt::format(" ({} to {})", Significant(interval->lower),
                                   Significant(interval->upper));
  }
  return text + fmt::format(" of {}", estimate->of);
}

}  // namespace

std::string PooledCsv(const std::vector<std::string>& by, std::span<const PooledGroup> groups) {
  CsvWriter csv;
  csv.AddAll(by);
  csv.AddAll(
      {"figure", "value", "count", "of", "lower", "upper", "confidence", "method", "clusters"});
  csv.EndLine();
  for (const PooledGroup& group : groups) {
    for (const auto& [name, estimate] : group.metrics) {
      for (const auto& value : group.values) csv.Add(TextOf(value));
      csv.Add(name).Add(estimate.value);
      csv.Add(FindMetric(name)->IsShare() ? std::to_string(estimate.count) : "").Add(estimate.of);
      const auto& interval = estimate.interval;
      csv.Add(interval ? std::optional(interval->lower) : std::nullopt);
      csv.Add(interval ? std::optional(interval->upper) : std::nullopt);
      csv.Add(group.confidence).Add(estimate.method).Add(estimate.clusters).EndLine();
    }
  }
  return csv.text();
}

std::string PooledTable(const std::vector<std::string>& by, std::span<const PooledGroup> groups,
                        const std::vector<std::string>& metrics) {
  TextTable table;
  for (const std::string& name : by) table.AddColumn(name, TextTable::Align::kLeft);
  for (const std::string& name : metrics) table.AddColumn(name);
  for (const PooledGroup& group : groups) {
    std::vector<std::string> cells;
    for (const auto& value : group.values) cells.push_back(TextOf(value));
    for (const std::string& name : metrics) {
      cells.push_back(CellText(name, Find(group.metrics, name)));
    }
    table.AddRow(std::move(cells));
  }
  return table.ToMarkdown();
}

}  // namespace fenestra
