#include "experiments/check/check_report.h"

#include <fmt/format.h>

#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"

namespace fenestra {
namespace {

std::string Subject(const BoundResult& result) {
  return result.cell.empty() ? result.text : fmt::format("{} | {}", result.text, result.cell);
}

// How many replicates would decide, or why nothing is known.
std::string Remark(const BoundResult& result) {
  std::string remark = result.note;
  if (result.verdict != Verdict::kUndecided || result.rows == 0) return remark;
  if (!remark.empty()) remark += "; ";
  if (result.replicates_to_decide) {
    return remark + fmt::format("about {} replicates would decide (now {})",
                                *result.replicates_to_decide, result.clusters);
  }
  return remark + "too close to the limit for any number of trials";
}

TextTable TableOf(const CheckResult& result, std::optional<bool> holding) {
  TextTable table;
  table.AddColumn("verdict", TextTable::Align::kLeft);
  table.AddColumn("bound", TextTable::Align::kLeft);
  table.AddColumn("measured", TextTable::Align::kLeft);
  table.AddColumn("95 % interval", TextTable::Align::kLeft);
  table.AddColumn("n");
  table.AddColumn("remark", TextTable::Align::kLeft);
  for (const BoundResult& bound : result.bounds) {
    const bool holds = bound.verdict == Verdict::kHolds;
    if (holding && *holding != holds) continue;
    table.AddRow({ToString(bound.verdict), Subject(bound), bound.measured,
                  bound.interval.empty() ? kAbsent : bound.interval, std::to_string(bound.rows),
                  Remark(bound)});
  }
  return table;
}

std::string Counts(const CheckResult& result) {
  return fmt::format("{} hold, {} violated, {} undecided", result.Count(Verdict::kHolds),
                     result.Count(Verdict::kViolated), result.Count(Verdict::kUndecided));
}

std::string Meaning(const CheckResult& result) {
  return fmt::format(
      "If all {} held, the chance that any is called violated would be at most {} (each tested at "
      "{:.2g}).\n",
      result.bounds.size(), result.false_alarm, result.test_level);
}

std::string XmlEscaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::string CheckForTerminal(const CheckResult& result) {
  return TableOf(result, std::nullopt).ToPlainText() + "\n" + Counts(result) + ".\n" +
         Meaning(result);
}

std::string CheckMarkdown(const CheckResult& result) {
  std::string text = fmt::format("### Fenestra: {}\n\n", Counts(result));
  if (const TextTable open = TableOf(result, false); !open.empty()) {
    text += open.ToMarkdown() + "\n";
  }
  if (const TextTable held = TableOf(result, true); !held.empty()) {
    text += fmt::format("<details><summary>What holds ({})</summary>\n\n{}\n</details>\n\n",
                        result.Count(Verdict::kHolds), held.ToMarkdown());
  }
  return text + Meaning(result);
}

std::string CheckJunitXml(const CheckResult& result, const std::string& suite,
                          bool undecided_fails) {
  const int undecided = result.Count(Verdict::kUndecided);
  const int failures = result.Count(Verdict::kViolated) + (undecided_fails ? undecided : 0);
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n",
      XmlEscaped(suite), result.bounds.size(), failures, undecided_fails ? 0 : undecided);
  for (const BoundResult& bound : result.bounds) {
    xml += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", XmlEscaped(suite),
                       XmlEscaped(Subject(bound)));
    const std::string message = XmlEscaped(
        fmt::format("measured {} in {} rows. {}", bound.measured, bound.rows, Remark(bound)));
    const bool fails = bound.verdict == Verdict::kViolated ||
                       (bound.verdict == Verdict::kUndecided && undecided_fails);
    if (fails) {
      xml += fmt::format(">\n    <failure message=\"{}: {}\"/>\n  </testcase>\n",
                         ToString(bound.verdict), message);
    } else if (bound.verdict == Verdict::kUndecided) {
      xml += fmt::format(">\n    <skipped message=\"undecided: {}\"/>\n  </testcase>\n", message);
    } else {
      xml += fmt::format(">\n    <system-out>{}</system-out>\n  </testcase>\n", message);
    }
  }
  return xml + "</testsuite>\n";
}

}  // namespace fenestra
