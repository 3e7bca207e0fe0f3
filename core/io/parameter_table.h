#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/io/yaml_reader.h"
#include "core/system/check.h"

namespace fenestra {

/// A value that a user can set by name: a switch, a number, or one of a few words.
using ParameterValue = std::variant<bool, double, std::string>;

/// The value as YAML and tables show it; numbers in the shortest form that reads back exactly.
std::string ToString(const ParameterValue& value);

/// Description of a parameter for users. Its name carries the unit.
struct ParameterInfo {
  enum class Type { kSwitch, kNumber, kInteger, kChoice };

  std::string name;
  std::string description;
  Type type = Type::kNumber;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices{};
  ParameterValue default_value = 0.0;

  /// "true or false", "a number from 0.1 to 100", "one of paper_target, facade".
  std::string Allowed() const;
  /// Why `value` is not allowed, or nullopt if it is.
  std::optional<std::string> Objection(const ParameterValue& value) const;
  /// Reads a value from YAML; a wrong type or a value out of range becomes a fault of the reader.
  std::optional<ParameterValue> Read(YamlReader& reader, const YAML::Node& node) const;
};

/// Names a field of a settings struct to a ParameterTable, for reading and for writing:
/// FENESTRA_FIELD(lens.blur_sigma_px).
// clang-format off
// NOLINTNEXTLINE(bugprone-macro-parentheses): a path of members cannot stand in parentheses.
#define FENESTRA_FIELD(path) [](auto& settings) -> decltype((settings.path)) { return settings.path; }
// clang-format on

/// The named parameters of a settings struct: the one place where a name, its unit, its range, its
/// description and the field that it sets stand together. Fields hold SI units; a name's unit is
/// `si_per_unit` of SI (pi/180 for degrees).
template <typename Settings>
class ParameterTable {
 public:
  struct Range {
    double min;
    double max;
    double si_per_unit = 1.0;
  };

  /// The way to a field. Made from a lambda without captures that takes constant settings, too, as
  /// FENESTRA_FIELD is.
  template <typename Value>
  struct Field {
    template <typename Lambda>
    Field(Lambda lambda) : of_constant(lambda), of(lambda) {}

    const Value& (*of_constant)(const Settings&);
    Value& (*of)(Settings&);
  };

  ParameterTable& Number(const std::string& name, Field<double> field, Range range,
                         const std::string& description) {
    const double scale = range.si_per_unit;
    return Add(
        {.name = name,
         .description = description,
         .type = ParameterInfo::Type::kNumber,
         .min = range.min,
         .max = range.max},
        [field, scale](const Settings& s) { return ParameterValue(field.of_constant(s) / scale); },
        [field, scale](Settings& s, const ParameterValue& value) {
          field.of(s) = std::get<double>(value) * scale;
        });
  }

  ParameterTable& Integer(const std::string& name, Field<int> field, Range range,
                          const std::string& description) {
    return Add(
        {.name = name,
         .description = description,
         .type = ParameterInfo::Type::kInteger,
         .min = range.min,
         .max = range.max},
        [field](const Settings& s) {
          return ParameterValue(static_cast<double>(field.of_constant(s)));
        },
        [field](Settings& s, const ParameterValue& value) {
          field.of(s) = static_cast<int>(std::get<double>(value));
        });
  }

  ParameterTable& Switch(const std::string& name, Field<bool> field,
                         const std::string& description) {
    return Add(
        {.name = name, .description = description, .type = ParameterInfo::Type::kSwitch},
        [field](const Settings& s) { return ParameterValue(field.of_constant(s)); },
        [field](Settings& s, const ParameterValue& value) { field.of(s) = std::get<bool>(value); });
  }

  ParameterTable& Choice(const std::string& name, Field<std::string> field,
                         const std::vector<std::string>& choices, const std::string& description) {
    return Add(
        {.name = name,
         .description = description,
         .type = ParameterInfo::Type::kChoice,
         .choices = choices},
        [field](const Settings& s) { return ParameterValue(field.of_constant(s)); },
        [field](Settings& s, const ParameterValue& value) {
          field.of(s) = std::get<std::string>(value);
        });
  }

  /// A choice whose field is an enumeration: its enumerators, from 0, are called `choices`.
  template <typename Lambda>
  requires std::is_enum_v<std::remove_reference_t<std::invoke_result_t<Lambda, Settings&>>>
      ParameterTable& Choice(const std::string& name, Lambda lambda,
                             const std::vector<std::string>& choices,
                             const std::string& description) {
    using Enumeration = std::remove_reference_t<std::invoke_result_t<Lambda, Settings&>>;
    const Field<Enumeration> field(lambda);
    return Add(
        {.name = name,
         .description = description,
         .type = ParameterInfo::Type::kChoice,
         .choices = choices},
        [field, choices](const Settings& s) {
          return ParameterValue(choices.at(static_cast<size_t>(field.of_constant(s))));
        },
        [field, choices](Settings& s, const ParameterValue& value) {
          const auto found =
              std::find(choices.begin(), choices.end(), std::get<std::string>(value));
          field.of(s) = static_cast<Enumeration>(found - choices.begin());
        });
  }

  /// All parameters of a part of the settings, under the same names.
  template <typename Part>
  ParameterTable& Adopt(const ParameterTable<Part>& parts, std::type_identity_t<Field<Part>> part) {
    for (const ParameterInfo& info : parts.infos()) {
      Add(
          info,
          [parts, part, name = info.name](const Settings& s) {
            return parts.Get(part.of_constant(s), name);
          },
          [parts, part, name = info.name](Settings& s, const ParameterValue& value) {
            parts.Set(part.of(s), name, value);
          });
    }
    return *this;
  }

  /// In the order in which they were added.
  const std::vector<ParameterInfo>& infos() const { return infos_; }

  const ParameterInfo* Find(const std::string& name) const {
    for (const ParameterInfo& info : infos_) {
      if (info.name == name) return &info;
    }
    return nullptr;
  }

  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const ParameterInfo& info : infos_) names.push_back(info.name);
    return names;
  }

  /// The name must be known and the value allowed; readers have checked that before.
  void Set(Settings& settings, const std::string& name, const ParameterValue& value) const {
    const size_t i = IndexOf(name);
    const auto objection = infos_[i].Objection(value);
    FENESTRA_CHECK(!objection, name + ": " + objection.value_or(""));
    setters_[i](settings, value);
  }

  ParameterValue Get(const Settings& settings, const std::string& name) const {
    return getters_[IndexOf(name)](settings);
  }

  /// The objections to all parameters whose values are not allowed (ParameterInfo::Objection).
  std::vector<std::string> Objections(const Settings& settings) const {
    std::vector<std::string> objections;
    for (size_t i = 0; i < infos_.size(); ++i) {
      const auto objection = infos_[i].Objection(getters_[i](settings));
      if (objection) objections.push_back(*objection);
    }
    return objections;
  }

 private:
  using Getter = std::function<ParameterValue(const Settings&)>;
  using Setter = std::function<void(Settings&, const ParameterValue&)>;

  ParameterTable& Add(ParameterInfo info, Getter get, Setter set) {
    FENESTRA_CHECK(Find(info.name) == nullptr, "parameter named twice: " + info.name);
    info.default_value = get(Settings{});
    infos_.push_back(std::move(info));
    getters_.push_back(std::move(get));
    setters_.push_back(std::move(set));
    return *this;
  }

  size_t IndexOf(const std::string& name) const {
    const ParameterInfo* info = Find(name);
    FENESTRA_CHECK(info != nullptr, "unknown parameter " + name);
    return static_cast<size_t>(info - infos_.data());
  }

  std::vector<ParameterInfo> infos_;
  std::vector<Getter> getters_;
  std::vector<Setter> setters_;
};

/// To 12 significant digits: what remains of 0.1 + 0.2 when it is written as people do.
double RoundTo12Digits(double value);

/// The default as people would write it: 15 degrees, not the 14.999999999999998 that come back
/// from radians.
ParameterValue WrittenDefault(const ParameterInfo& parameter);

}  // namespace fenestra
