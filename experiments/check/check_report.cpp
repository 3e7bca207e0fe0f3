#include "experiments/check/check_report.h"

#include <fmt/format.h>

#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"

namespace fenestra {
namespace {

std::string Subject(const LimitResult& result) {
  return result.cell.empty() ? result.text : fmt::format("{} | {}", result.text, result.cell);
}

// How many replicates would decide, or why nothing is known.
std::string Remark(const LimitResult& result) {
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
  table.AddColumn("limit", TextTable::Align::kLeft);
  table.AddColumn("measured", TextTable::Align::kLeft);
  table.AddColumn("95 % interval", TextTable::Align::kLeft);
  table.AddColumn("n");
  table.AddColumn("remark", TextTable::Align::kLeft);
  for (const LimitResult& limit : result.limits) {
    const bool holds = limit.verdict == Verdict::kHolds;
    if (holding && *holding != holds) continue;
    table.AddRow({ToString(limit.verdict), Subject(limit), limit.measured,
                  limit.interval.empty() ? kAbsent : limit.interval, std::to_string(limit.rows),
                  Remark(limit)});
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
      result.limits.size(), result.false_alarm, result.test_level);
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
      XmlEscaped(suite), result.limits.size(), failures, undecided_fails ? 0 : undecided);
  for (const LimitResult& limit : result.limits) {
    xml += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", XmlEscaped(suite),
                       XmlEscaped(Subject(limit)));
    const std::string message = XmlEscaped(
        fmt::format("measured {} in {} rows. {}", limit.measured, limit.rows, Remark(limit)));
    const bool fails = limit.verdict == Verdict::kViolated ||
                       (limit.verdict == Verdict::kUndecided && undecided_fails);
    if (fails) {
      xml += fmt::format(">\n    <failure message=\"{}: {}\"/>\n  </testcase>\n",
                         ToString(limit.verdict), message);
    } else if (limit.verdict == Verdict::kUndecided) {
      xml += fmt::format(">\n    <skipped message=\"undecided: {}\"/>\n  </testcase>\n", message);
    } else {
      xml += fmt::format(">\n    <system-out>{}</system-out>\n  </testcase>\n", message);
    }
  }
  return xml + "</testsuite>\n";
}

}  // namespace fenestra
