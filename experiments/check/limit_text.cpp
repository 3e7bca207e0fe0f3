#include "experiments/check/limit_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/io/faults.h"
#include "experiments/study/factors.h"

namespace fenestra {
namespace {

bool IsWordCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.' ||
         c == '+';
}

// Words (names and numbers), comparisons and single marks; a sign is a word of its own only where
// a blank follows it.
std::vector<std::string> Tokens(const std::string& text) {
  std::vector<std::string> tokens;
  for (size_t i = 0; i < text.size();) {
    if (std::isspace(static_cast<unsigned char>(text[i])) != 0) {
      ++i;
      continue;
    }
    size_t end = i + 1;
    if (IsWordCharacter(text[i])) {
      while (end < text.size() && IsWordCharacter(text[end])) ++end;
    } else if (std::string_view("<>!").find(text[i]) != std::string_view::npos &&
               end < text.size() && text[end] == '=') {
      ++end;
    }
    tokens.push_back(text.substr(i, end - i));
    i = end;
  }
  return tokens;
}

std::optional<double> ToNumber(const std::string& word) {
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

class Parser {
 public:
  Parser(const std::string& text, double default_confidence) : tokens_(Tokens(text)) {
    limit_.text = text;
    limit_.confidence = default_confidence;
  }

  Limit Parse() {
    ReadMetric();
    ReadLimit();
    while (at_ < tokens_.size()) {
      const std::string word = Next("with, in or where");
      if (word == "with") {
        Expect("confidence");
        limit_.confidence = ReadNumber("the confidence");
        if (!(limit_.confidence > 0.0 && limit_.confidence < 1.0)) {
          throw LimitTextError(
              fmt::format("the confidence must lie between 0 and 1, not be {}", limit_.confidence));
        }
      } else if (word == "in") {
        Expect("each");
        Expect("cell");
        limit_.in_each_cell = true;
      } else if (word == "where") {
        ReadConditions();
      } else {
        Unexpected(word, "with, in, where or the end");
      }
    }
    return limit_;
  }

  std::vector<Condition> ParseWhere() {
    ReadConditions();
    return limit_.where;
  }

 private:
  [[noreturn]] static void Unexpected(const std::string& found, const std::string& wanted) {
    throw LimitTextError(fmt::format("has '{}' where {} was expected", found, wanted));
  }

  std::string Next(const std::string& wanted) {
    if (at_ == tokens_.size()) {
      throw LimitTextError(fmt::format("ends where {} was expected", wanted));
    }
    return tokens_[at_++];
  }

  bool TakeIf(const std::string& word) {
    if (at_ == tokens_.size() || tokens_[at_] != word) return false;
    ++at_;
    return true;
  }

  void Expect(const std::string& word) {
    const std::string quoted = fmt::format("'{}'", word);
    if (const std::string found = Next(quoted); found != word) Unexpected(found, quoted);
  }

  double ReadNumber(const std::string& what) {
    const std::string word = Next(what);
    const auto number = ToNumber(word);
    if (!number) Unexpected(word, what + ", a number,");
    return *number;
  }

  void ReadMetric() {
    const std::string statistic = Next("a metric such as p95(centroid_error_mm)");
    if (const auto named = FindMetric(statistic)) {
      limit_.metric = *named;
      return;
    }
    limit_.metric = MetricOf(statistic);
    Expect("(");
    const std::string of = Next("what the metric is of");
    if (limit_.metric.kind == Metric::Kind::kRate) {
      ReadOutcome(of);
    } else {
      ReadQuantity(of);
    }
    Expect(")");
  }

  // Of a statistic, without what it is of.
  static Metric MetricOf(const std::string& statistic) {
    if (statistic == "rate") return {.kind = Metric::Kind::kRate};
    if (statistic == "rmse") return {.kind = Metric::Kind::kRmse};
    if (statistic == "trimmed_rmse") return {.kind = Metric::Kind::kTrimmedRmse};
    if (statistic == "bias") return {.kind = Metric::Kind::kBias};
    if (statistic == "median") return {.kind = Metric::Kind::kQuantile, .level = 0.5};
    const auto percent = statistic.starts_with("p") ? ToNumber(statistic.substr(1)) : std::nullopt;
    if (!percent || !(*percent > 0.0 && *percent < 100.0)) {
      Unexpected(statistic,
                 "rate, median, rmse, trimmed_rmse, bias, a quantile such as p95, or the name of a "
                 "metric");
    }
    return {.kind = Metric::Kind::kQuantile, .level = *percent / 100.0};
  }

  void ReadOutcome(const std::string& word) {
    const auto outcome = ParseOutcome(word);
    if (!outcome || *outcome == Outcome::kOutOfView) {
      std::vector<std::string> names;
      for (const Outcome known : kAllOutcomes) {
        if (known != Outcome::kOutOfView) names.emplace_back(ToString(known));
      }
      Unexpected(word, fmt::format("an outcome ({})", fmt::join(names, ", ")));
    }
    limit_.metric.outcome = *outcome;
  }

  void ReadQuantity(const std::string& word) {
    std::vector<std::string> names;
    for (const Quantity known : AllQuantities()) {
      names.emplace_back(ToString(known));
      if (word != names.back()) continue;
      limit_.metric.quantity = known;
      return;
    }
    Unexpected(word, fmt::format("a quantity ({})", fmt::join(names, ", ")));
  }

  void ReadLimit() {
    const std::string comparison = Next("<= or >=");
    if (comparison != "<=" && comparison != ">=") Unexpected(comparison, "<= or >=");
    limit_.is_upper = comparison == "<=";
    const bool rate = limit_.metric.IsShare();
    if (TakeIf("baseline")) {
      if (!rate) throw LimitTextError("only a rate is held against 'baseline + number'");
      limit_.to_baseline = true;
      if (TakeIf("+")) {
        limit_.value = ReadNumber("a difference");
      } else if (TakeIf("-")) {
        limit_.value = -ReadNumber("a difference");
      }
      CheckLimit(-1.0, 1.0, "a difference of rates");
      return;
    }
    limit_.value = ReadNumber("a limit");
    if (TakeIf("times")) {
      Expect("baseline");
      if (limit_.metric.kind != Metric::Kind::kRmse) {
        throw LimitTextError("only an rmse is held against 'number times baseline'");
      }
      limit_.to_baseline = true;
      CheckLimit(1e-6, 1e6, "a ratio");
    } else if (rate) {
      CheckLimit(0.0, 1.0, "a rate");
    } else if (limit_.metric.kind != Metric::Kind::kBias) {
      CheckLimit(0.0, 1e9, "such a limit");
    }
  }

  void CheckLimit(double min, double max, const char* what) {
    if (limit_.value >= min && limit_.value <= max) return;
    throw LimitTextError(
        fmt::format("{} must lie between {} and {}, not be {}", what, min, max, limit_.value));
  }

  void ReadConditions() {
    do ReadCondition();
    while (TakeIf("and"));
    if (at_ < tokens_.size()) Unexpected(Next(""), "and, or the end");
  }

  void ReadCondition() {
    Condition condition;
    condition.name = Next("a condition");
    const std::string comparison = Next("a comparison");
    if (comparison == "in") {
      condition.comparison = Comparison::kIn;
      Expect("[");
      do condition.values.push_back(ReadValue(condition.name));
      while (TakeIf(","));
      Expect("]");
    } else {
      condition.comparison = ReadComparison(comparison);
      condition.values.push_back(ReadValue(condition.name));
    }
    const bool ordered = condition.comparison != Comparison::kEqual &&
                         condition.comparison != Comparison::kNotEqual &&
                         condition.comparison != Comparison::kIn;
    if (ordered && !std::holds_alternative<double>(condition.values.front())) {
      throw LimitTextError(fmt::format("{} has no order: use =, != or in", condition.name));
    }
    limit_.where.push_back(std::move(condition));
  }

  static Comparison ReadComparison(const std::string& word) {
    if (word == "=") return Comparison::kEqual;
    if (word == "!=") return Comparison::kNotEqual;
    if (word == "<") return Comparison::kLess;
    if (word == "<=") return Comparison::kAtMost;
    if (word == ">") return Comparison::kGreater;
    if (word == ">=") return Comparison::kAtLeast;
    Unexpected(word, "a comparison (=, !=, <, <=, >, >=, in)");
  }

  ParameterValue ReadValue(const std::string& name) {
    const std::string word = Next("a value of " + name);
    if (name == "detector" || name == "part" || name == "sensor") return word;
    const ParameterInfo* info = Factors().Find(name);
    if (info == nullptr) {
      std::vector<std::string> names = Factors().Names();
      names.insert(names.end(), {"detector", "part", "sensor"});
      throw LimitTextError(fmt::format("'{}' is no factor, detector, part or sensor.{}", name,
                                       DidYouMean(name, names)));
    }
    switch (info->type) {
      case ParameterInfo::Type::kSwitch:
        if (word == "true" || word == "false") return word == "true";
        break;
      case ParameterInfo::Type::kChoice:
        if (std::find(info->choices.begin(), info->choices.end(), word) != info->choices.end()) {
          return word;
        }
        break;
      default:
        if (const auto number = ToNumber(word)) return *number;
    }
    Unexpected(word, fmt::format("a value of {} ({})", name, info->Allowed()));
  }

  std::vector<std::string> tokens_;
  size_t at_ = 0;
  Limit limit_;
};

}  // namespace

Limit ParseLimit(const std::string& text, double default_confidence) {
  return Parser(text, default_confidence).Parse();
}

std::vector<Condition> ParseConditions(const std::string& text) {
  return Parser(text, 0.95).ParseWhere();
}

}  // namespace fenestra
