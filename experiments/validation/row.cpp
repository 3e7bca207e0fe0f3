#include "experiments/validation/row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/text_table.h"

namespace fenestra::validation {

std::string ToString(Origin origin) {
  switch (origin) {
    case Origin::kPredicted:
      return "predicted";
    case Origin::kFitted:
      return "fitted";
    case Origin::kDesign:
      return "design";
    case Origin::kAssumed:
      return "assumed";
  }
  return {};
}

std::string ToString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kHolds:
      return "holds";
    case Verdict::kMisfit:
      return "**misfit**";
    case Verdict::kNotJudged:
      return "not judged";
  }
  return {};
}

std::string ToMarkdown(const std::vector<Row>& rows) {
  TextTable table;
  for (const char* heading : {"phenomenon", "recording", "recorded", "Fenestra", "origin",
                              "agreement, 95 %", "verdict"}) {
    table.AddColumn(heading, TextTable::Align::kLeft);
  }
  for (const Row& row : rows) {
    table.AddRow({row.phenomenon, row.recording, row.recorded, row.simulated, ToString(row.origin),
                  row.agreement, ToString(row.verdict)});
  }
  const auto count = [&rows](Origin origin, Verdict verdict) {
    return std::count_if(rows.begin(), rows.end(), [&](const Row& row) {
      return row.origin == origin && row.verdict == verdict;
    });
  };
  std::string summary;
  for (const Origin origin :
       {Origin::kPredicted, Origin::kFitted, Origin::kDesign, Origin::kAssumed}) {
    summary += fmt::format("{}{}: {} hold, {} misfit, {} not judged", summary.empty() ? "" : "; ",
                           ToString(origin), count(origin, Verdict::kHolds),
                           count(origin, Verdict::kMisfit), count(origin, Verdict::kNotJudged));
  }
  return fmt::format("{}\nRows {}.\n", table.ToMarkdown(), summary);
}

void JudgeRatio(Row& row, const Estimated& recorded, const Estimated& simulated, double tau) {
  const double ratio = simulated.value / recorded.value;
  const double sigma =
      std::hypot(recorded.error / recorded.value, simulated.error / simulated.value, tau);
  constexpr double kTwoSided95 = 1.96;
  const double factor = std::exp(kTwoSided95 * sigma);
  row.agreement =
      fmt::format("ratio {:.2f}, {:.2f} to {:.2f}", ratio, ratio / factor, ratio * factor);
  const bool holds = ratio / factor <= 1.0 && ratio * factor >= 1.0;
  row.verdict = holds ? Verdict::kHolds : Verdict::kMisfit;
}

void JudgeRange(Row& row, double simulated, double low, double high, const std::string& unit) {
  row.agreement = fmt::format("{:.3g} to {:.3g} {}", low, high, unit);
  row.verdict = simulated >= low && simulated <= high ? Verdict::kHolds : Verdict::kMisfit;
}

std::string Text(const Estimated& figure, const std::string& unit, int decimals) {
  return fmt::format("{:.{}f} ± {:.{}f} {}", figure.value, decimals, figure.error, decimals, unit);
}

}  // namespace fenestra::validation
