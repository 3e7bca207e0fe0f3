#include "experiments/report/error_budget_report.h"

#include <fmt/format.h>

#include "experiments/output/file_formats.h"
#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"
#include "experiments/report/report_section.h"

namespace fenestra {
namespace {

std::string Share(double value, const Interval& interval) {
  return fmt::format("{:.0f} % ({:.0f} to {:.0f})", 100.0 * value, 100.0 * interval.lower,
                     100.0 * interval.upper);
}

// A length with its interval, in mm.
std::string Length(double value_m, const std::optional<Interval>& interval_m) {
  std::string value = Significant(1e3 * value_m);
  if (!interval_m) return value;
  return fmt::format("{} ({} to {})", value, Significant(1e3 * interval_m->lower),
                     Significant(1e3 * interval_m->upper));
}

std::string Table(const ErrorBudget& budget) {
  TextTable table;
  table.AddColumn("cause", TextTable::Align::kLeft);
  for (const CoordinateBudget& coordinate : budget.coordinates) {
    table.AddColumn(coordinate.coordinate + ": alone");
    table.AddColumn("total");
  }
  for (size_t i = 0; i < budget.causes.size(); ++i) {
    std::vector<std::string> cells{budget.causes[i]};
    for (const CoordinateBudget& coordinate : budget.coordinates) {
      if (coordinate.indices) {
        const SobolIndex& index = (*coordinate.indices)[i];
        cells.push_back(Share(index.first, index.first_interval));
        cells.push_back(Share(index.total, index.total_interval));
      } else {
        cells.insert(cells.end(), {kAbsent, kAbsent});
      }
    }
    table.AddRow(std::move(cells));
  }
  std::vector<std::string> means{"mean [mm]"};
  std::vector<std::string> deviations{"standard deviation [mm]"};
  for (const CoordinateBudget& c : budget.coordinates) {
    means.insert(means.end(), {"", Length(c.mean_m, c.mean_interval_m)});
    deviations.insert(deviations.end(),
                      {"", Length(c.standard_deviation_m, c.standard_deviation_interval_m)});
  }
  table.AddRow(std::move(means));
  table.AddRow(std::move(deviations));
  return table.ToMarkdown();
}

constexpr const char* kHowToReadBudget = R"md(
*alone* is the first-order Sobol index: the share of the error's variance that the cause explains by
itself. *total* is the total index: the share that would be gone without the cause's spread; what it
exceeds *alone* by comes from the cause acting together with others. In parentheses 95 % intervals
(bootstrap over rows, Martinez' estimator; of the mean Student's). The errors are signed, in the frame of the scored camera,
over rows of the design whose trials are all hits: the indices say nothing about misses.
)md";

}  // namespace

std::string ErrorBudgetMarkdown(std::span<const ErrorBudget> budgets) {
  if (budgets.empty()) return "";
  std::string text = "## What the errors come from\n\n";
  for (const ErrorBudget& budget : budgets) {
    text +=
        fmt::format("### {}: {}, {}{}{}\n\n", budget.part, ToString(budget.sensor), budget.detector,
                    budget.levels.empty() ? "" : ", ", LevelsText(budget.levels));
    text += fmt::format(
        "{} of {} trials are hits ({} missed or worse); {} of {} rows have hits "
        "only.\n\n",
        budget.hits, budget.trials, Percent(1.0 - static_cast<double>(budget.hits) / budget.trials),
        budget.used_rows, budget.rows);
    text += Table(budget) + "\n";
  }
  return text + kHowToReadBudget;
}

std::string ErrorBudgetCsv(std::span<const ErrorBudget> budgets) {
  CsvWriter csv;
  csv.AddAll({"part",
              "sensor",
              "cell",
              "detector",
              "trials",
              "hits",
              "rows",
              "used_rows",
              "coordinate",
              "mean_mm",
              "standard_deviation_mm",
              "cause",
              "first",
              "first_lower95",
              "first_upper95",
              "total",
              "total_lower95",
              "total_upper95",
              "mean_lower95_mm",
              "mean_upper95_mm",
              "standard_deviation_lower95_mm",
              "standard_deviation_upper95_mm"});
  csv.EndLine();
  for (const ErrorBudget& budget : budgets) {
    for (const CoordinateBudget& coordinate : budget.coordinates) {
      for (size_t i = 0; i < budget.causes.size(); ++i) {
        csv.Add(budget.part).Add(ToString(budget.sensor)).Add(budget.cell).Add(budget.detector);
        csv.Add(budget.trials).Add(budget.hits).Add(budget.rows).Add(budget.used_rows);
        csv.Add(coordinate.coordinate).Add(1e3 * coordinate.mean_m);
        csv.Add(1e3 * coordinate.standard_deviation_m).Add(budget.causes[i]);
        if (coordinate.indices) {
          const SobolIndex& index = (*coordinate.indices)[i];
          csv.Add(index.first).Add(index.first_interval.lower).Add(index.first_interval.upper);
          csv.Add(index.total).Add(index.total_interval.lower).Add(index.total_interval.upper);
        } else {
          csv.AddAll(std::vector<std::string>(6));
        }
        for (const auto& interval :
             {coordinate.mean_interval_m, coordinate.standard_deviation_interval_m}) {
          if (interval) {
            csv.Add(1e3 * interval->lower).Add(1e3 * interval->upper);
          } else {
            csv.AddAll(std::vector<std::string>(2));
          }
        }
        csv.EndLine();
      }
    }
  }
  return csv.text();
}

}  // namespace fenestra
