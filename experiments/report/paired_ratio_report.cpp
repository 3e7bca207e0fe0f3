#include "experiments/report/paired_ratio_report.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/output/text_table.h"

namespace fenestra {
namespace {

std::string CellText(const Ratio& ratio) {
  if (std::isnan(ratio.value)) return "—";
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", ratio.value, ratio.interval90.lower,
                     ratio.interval90.upper);
}

}  // namespace

std::string PairedRatioTable(std::span<const PairedCells> cells, const std::string& factor,
                             const RandomStream& stream) {
  TextTable table;
  for (const char* heading : {"part", "detector", "levels", "compared"}) {
    table.AddColumn(heading, TextTable::Align::kLeft);
  }
  for (const char* heading : {"pairs", "RMSE, ratio", "P95, ratio"}) table.AddColumn(heading);
  const auto add = [&](const PairedCells& of, const std::string& levels,
                       std::span<const std::vector<ErrorPair>> pairs, uint64_t index) {
    const PairedRatios ratios = RatiosOf(pairs, stream.Child("row", index));
    table.AddRow({of.part, of.detector, levels, fmt::format("{} : {}", of.level, of.base_level),
                  std::to_string(ratios.pairs), CellText(ratios.rmse), CellText(ratios.p95_error)});
  };
  // Rows of one part, detector and level, then what they have in common.
  for (size_t begin = 0; begin < cells.size();) {
    const PairedCells& first = cells[begin];
    size_t end = begin;
    std::vector<std::vector<ErrorPair>> pooled;
    while (end < cells.size() && cells[end].part == first.part &&
           cells[end].detector == first.detector && cells[end].level == first.level) {
      add(cells[end], LevelsText(cells[end].levels), {&cells[end].pairs, 1}, end);
      pooled.push_back(cells[end++].pairs);
    }
    if (pooled.size() > 1) add(first, "all, geometric mean", pooled, cells.size() + begin);
    begin = end;
  }
  return fmt::format(
      "Ratios between levels of {}, trial by trial, with 90 % bootstrap intervals\n\n{}\n", factor,
      table.ToMarkdown());
}

}  // namespace fenestra
