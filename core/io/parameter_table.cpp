#include "core/io/parameter_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/faults.h"

namespace fenestra {

std::string ToString(const ParameterValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return std::get<std::string>(value);
}

std::string ParameterInfo::Allowed() const {
  switch (type) {
    case Type::kSwitch:
      return "true or false";
    case Type::kChoice:
      return fmt::format("one of {}", fmt::join(choices, ", "));
    case Type::kNumber:
    case Type::kInteger:
      break;
  }
  const char* kind = type == Type::kInteger ? "a whole number" : "a number";
  return fmt::format("{} from {:g} to {:g}", kind, min, max);
}

std::optional<std::string> ParameterInfo::Objection(const ParameterValue& value) const {
  bool good = false;
  switch (type) {
    case Type::kSwitch:
      good = std::holds_alternative<bool>(value);
      break;
    case Type::kChoice: {
      const std::string* word = std::get_if<std::string>(&value);
      good = word != nullptr && std::find(choices.begin(), choices.end(), *word) != choices.end();
      break;
    }
    case Type::kNumber:
    case Type::kInteger: {
      const double* number = std::get_if<double>(&value);
      good = number != nullptr && *number >= min && *number <= max &&
             (type == Type::kNumber || *number == std::floor(*number));
      break;
    }
  }
  if (good) return std::nullopt;
  std::string hint;
  if (type == Type::kChoice && std::holds_alternative<std::string>(value)) {
    hint = DidYouMean(std::get<std::string>(value), choices);
  }
  return fmt::format("{} must be {}, not '{}'.{}", name, Allowed(), ToString(value), hint);
}

std::optional<ParameterValue> ParameterInfo::Read(YamlReader& reader,
                                                  const YAML::Node& node) const {
  std::optional<ParameterValue> value;
  if (!node.IsScalar()) {
    reader.AddFault(
        node, fmt::format("{} must be {}, not {}", name, Allowed(), YamlReader::Describe(node)));
    return std::nullopt;
  }
  if (type == Type::kSwitch) {
    value = reader.Boolean(node, name);
  } else if (type == Type::kChoice) {
    value = reader.Text(node, name);
  } else {
    value = reader.Number(node, name);
  }
  if (!value) return std::nullopt;
  if (const auto objection = Objection(*value)) {
    reader.AddFault(node, *objection);
    return std::nullopt;
  }
  return value;
}

double RoundTo12Digits(double value) {
  return std::stod(fmt::format("{:.11e}", value));
}

ParameterValue WrittenDefault(const ParameterInfo& parameter) {
  const double* number = std::get_if<double>(&parameter.default_value);
  return number != nullptr ? RoundTo12Digits(*number) : parameter.default_value;
}

}  // namespace fenestra
