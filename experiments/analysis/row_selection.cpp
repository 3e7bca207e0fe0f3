#include "experiments/analysis/row_selection.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/faults.h"

namespace fenestra {
namespace {

std::optional<ParameterValue> Find(const FactorValues& values, const std::string& name) {
  for (const auto& [factor, value] : values) {
    if (factor == name) return value;
  }
  return std::nullopt;
}

bool Holds(const ParameterValue& value, const Condition& condition) {
  const ParameterValue& wanted = condition.values.front();
  switch (condition.comparison) {
    case Comparison::kEqual:
      return value == wanted;
    case Comparison::kNotEqual:
      return value != wanted;
    case Comparison::kIn:
      return std::find(condition.values.begin(), condition.values.end(), value) !=
             condition.values.end();
    default:
      break;
  }
  const double number = std::get<double>(value);
  const double limit = std::get<double>(wanted);
  switch (condition.comparison) {
    case Comparison::kLess:
      return number < limit;
    case Comparison::kAtMost:
      return number <= limit;
    case Comparison::kGreater:
      return number > limit;
    default:
      return number >= limit;
  }
}

// The words that a condition on `name` may use; empty if `name` is a factor.
std::vector<std::string> KnownWords(const Study& study, const std::string& name) {
  std::vector<std::string> words;
  for (const StudyPart& part : study.parts) {
    if (name == "part") words.push_back(part.name);
    if (name == "sensor") {
      for (const SensorKind sensor : part.sensors) words.emplace_back(ToString(sensor));
    }
    if (name == "detector") {
      for (const DetectorChoice& choice : part.detectors) words.push_back(choice.label);
    }
  }
  return words;
}

bool ConcernsAnyPart(const Study& study, const std::string& factor) {
  return std::any_of(study.parts.begin(), study.parts.end(), [&factor](const StudyPart& part) {
    return std::any_of(part.factors.begin(), part.factors.end(),
                       [&factor](const Factor& f) { return f.name == factor; });
  });
}

std::vector<std::string> ObjectionsTo(const Study& study, const Condition& condition) {
  const std::vector<std::string> known = KnownWords(study, condition.name);
  if (known.empty()) {
    if (ConcernsAnyPart(study, condition.name)) return {};
    return {fmt::format("{} has no effect in any part of '{}'", condition.name, study.name)};
  }
  std::vector<std::string> objections;
  for (const ParameterValue& value : condition.values) {
    const std::string& word = std::get<std::string>(value);
    if (std::find(known.begin(), known.end(), word) != known.end()) continue;
    objections.push_back(fmt::format("'{}' has no {} '{}'.{}", study.name, condition.name, word,
                                     DidYouMean(word, known)));
  }
  return objections;
}

}  // namespace

RowSelection::RowSelection(const Study& study, std::span<const Cell> cells)
    : study_(study), cells_(cells) {}

std::vector<std::string> RowSelection::Objections(std::span<const Condition> where) const {
  std::vector<std::string> objections;
  for (const Condition& condition : where) {
    for (std::string& message : ObjectionsTo(study_, condition))
      objections.push_back(std::move(message));
  }
  return objections;
}

std::optional<ParameterValue> RowSelection::ValueOf(const TrialRecord& row,
                                                    const std::string& name) const {
  if (name == "detector") return row.detector;
  if (name == "part") return row.part;
  if (name == "sensor") return std::string(ToString(row.sensor));
  if (auto drawn = Find(row.drawn, name)) return drawn;
  if (auto level = Find(row.levels, name)) return level;
  if (!Concerns(GroupOf(name), row.sensor)) return std::nullopt;
  return Factors().Get(cells_[static_cast<size_t>(row.cell)].settings, name);
}

bool RowSelection::Matches(const TrialRecord& row, const Condition& condition) const {
  const auto value = ValueOf(row, condition.name);
  return value && Holds(*value, condition);
}

bool RowSelection::Matches(const TrialRecord& row, std::span<const Condition> where) const {
  return std::all_of(where.begin(), where.end(),
                     [&](const Condition& condition) { return Matches(row, condition); });
}

}  // namespace fenestra
