#include "experiments/report/envelope_report.h"

#include <fmt/format.h>

#include "experiments/output/file_formats.h"
#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"
#include "experiments/report/report_section.h"
#include "experiments/study/metric.h"

namespace fenestra {
namespace {

const EnvelopeRule& RuleOf(const Study& study, const EnvelopeCurve& envelope) {
  return *study.parts[envelope.curve.part_index].envelope;
}

std::string NameForPeople(const std::string& metric) {
  if (metric == "hit_rate") return "hit rate";
  if (metric == "p50_error_mm") return "P50";
  if (metric == "p95_error_mm") return "P95";
  return metric;
}

std::string RequirementText(const EnvelopeRule& rule) {
  std::vector<std::string> demands;
  for (const auto& [metric, value] : rule.require) {
    const bool is_share = FindMetric(metric)->IsShare();
    demands.push_back(fmt::format("{} {} {:g} {}", NameForPeople(metric), is_share ? "≥" : "≤",
                                  is_share ? 100.0 * value : value, is_share ? "%" : "mm"));
  }
  return fmt::format("{}, each shown with {:g} % confidence", fmt::join(demands, " and "),
                     100.0 * rule.confidence);
}

// "from 1.4 to 6.5 (6.6 does not)".
std::string RangeText(const HoldingRange& range) {
  std::string text = fmt::format("{:g} to {:g}", range.from, range.to);
  std::vector<std::string> beyond;
  if (range.fails_below) beyond.push_back(fmt::format("{:g}", *range.fails_below));
  if (range.fails_above) beyond.push_back(fmt::format("{:g}", *range.fails_above));
  if (!beyond.empty()) text += fmt::format(" (not at {})", fmt::join(beyond, ", "));
  return text;
}

std::string RangesText(const EnvelopeCurve& envelope) {
  if (envelope.holds.empty()) return "nowhere";
  std::string text;
  for (const HoldingRange& range : envelope.holds) {
    text += (text.empty() ? "" : "; ") + RangeText(range);
  }
  return text;
}

constexpr const char* kHowToReadEnvelope = R"md(
The requirement holds at a level if the lower confidence limit of each demanded share (Clopper and
Pearson, one-sided) reaches it; a miss is never good. Elsewhere it fails, or the trials do not
suffice to show that it holds. The confidence is that of each level by itself. Levels between those
that were run are taken to behave as their neighbours do.
)md";

}  // namespace

std::string EnvelopeMarkdown(const Study& study, std::span<const EnvelopeCurve> envelopes) {
  if (envelopes.empty()) return "";
  std::string text = "## Envelope\n\n";
  for (size_t begin = 0; begin < envelopes.size();) {
    const LevelCurve& head = envelopes[begin].curve;
    const EnvelopeRule& rule = RuleOf(study, envelopes[begin]);
    text += fmt::format("### {}: {}\n\nWhere the requirement holds: {}.\n\n", head.part,
                        ToString(head.sensor), RequirementText(rule));
    TextTable table;
    table.AddColumn("levels", TextTable::Align::kLeft);
    table.AddColumn("detector", TextTable::Align::kLeft);
    table.AddColumn(rule.over);
    table.AddColumn("levels run");
    table.AddColumn("trials");
    while (begin < envelopes.size() && envelopes[begin].curve.part == head.part &&
           envelopes[begin].curve.sensor == head.sensor) {
      const EnvelopeCurve& envelope = envelopes[begin++];
      table.AddRow({LevelsText(envelope.curve.others), envelope.detector, RangesText(envelope),
                    fmt::format("{} of {}", envelope.tested_levels, envelope.curve.level.size()),
                    std::to_string(envelope.trials)});
    }
    text += table.ToMarkdown() + "\n";
  }
  return text + kHowToReadEnvelope;
}

std::string EnvelopeCsv(const Study& study, std::span<const EnvelopeCurve> envelopes) {
  CsvWriter csv;
  csv.AddAll({"part", "sensor", "detector", "levels", "over", "holds_from", "holds_to",
              "not_below_at", "not_above_at", "levels_run", "trials"});
  csv.EndLine();
  for (const EnvelopeCurve& envelope : envelopes) {
    std::vector<std::optional<HoldingRange>> ranges(envelope.holds.begin(), envelope.holds.end());
    if (ranges.empty()) ranges.push_back(std::nullopt);
    for (const auto& range : ranges) {
      csv.Add(envelope.curve.part).Add(ToString(envelope.curve.sensor)).Add(envelope.detector);
      csv.Add(LevelsText(envelope.curve.others)).Add(RuleOf(study, envelope).over);
      csv.Add(range ? std::optional(range->from) : std::nullopt);
      csv.Add(range ? std::optional(range->to) : std::nullopt);
      csv.Add(range ? range->fails_below : std::nullopt);
      csv.Add(range ? range->fails_above : std::nullopt);
      csv.Add(envelope.tested_levels).Add(envelope.trials).EndLine();
    }
  }
  return csv.text();
}

}  // namespace fenestra
