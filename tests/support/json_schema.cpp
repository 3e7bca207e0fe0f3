#include "tests/support/json_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>

#include "core/system/check.h"

namespace fenestra {
namespace {

using nlohmann::json;

class Validator {
 public:
  explicit Validator(const json& root) : root_(root) {}

  std::vector<std::string> Check(const json& schema, const json& value, const std::string& path) {
    std::vector<std::string> faults;
    for (const auto& [word, argument] : schema.items()) {
      for (std::string& fault : CheckWord(schema, word, argument, value, path)) {
        faults.push_back(std::move(fault));
      }
    }
    return faults;
  }

 private:
  using Faults = std::vector<std::string>;

  Faults CheckWord(const json& schema, const std::string& word, const json& argument,
                   const json& value, const std::string& path) {
    static const std::set<std::string> kNotes{"$schema", "title", "description", "default",
                                              "definitions"};
    if (kNotes.contains(word)) return {};
    if (word == "$ref") {
      const std::string pointer = argument.get<std::string>().substr(1);
      return Check(root_.at(json::json_pointer(pointer)), value, path);
    }
    if (word == "anyOf" || word == "oneOf") return CheckAlternatives(word, argument, value, path);
    if (word == "properties") return CheckProperties(argument, value, path);
    if (word == "additionalProperties") return CheckOthers(schema, argument, value, path);
    if (word == "items") return CheckItems(argument, value, path);
    return Holds(word, argument, value) ? Faults{} : Faults{path + ": breaks " + word};
  }

  Faults CheckAlternatives(const std::string& word, const json& schemas, const json& value,
                           const std::string& path) {
    int good = 0;
    Faults faults{path + ": none of the forms"};
    for (const json& schema : schemas) {
      const Faults here = Check(schema, value, path);
      good += here.empty() ? 1 : 0;
      faults.insert(faults.end(), here.begin(), here.end());
    }
    return (word == "anyOf" ? good >= 1 : good == 1) ? Faults{} : faults;
  }

  Faults CheckProperties(const json& properties, const json& value, const std::string& path) {
    Faults faults;
    if (!value.is_object()) return faults;
    for (const auto& [key, schema] : properties.items()) {
      if (!value.contains(key)) continue;
      const Faults here = Check(schema, value.at(key), path + "/" + key);
      faults.insert(faults.end(), here.begin(), here.end());
    }
    return faults;
  }

  Faults CheckOthers(const json& schema, const json& argument, const json& value,
                     const std::string& path) {
    Faults faults;
    if (!value.is_object()) return faults;
    for (const auto& [key, item] : value.items()) {
      if (schema.contains("properties") && schema.at("properties").contains(key)) continue;
      if (argument.is_boolean()) {
        if (!argument.get<bool>()) faults.push_back(path + ": unknown key " + key);
        continue;
      }
      const Faults here = Check(argument, item, path + "/" + key);
      faults.insert(faults.end(), here.begin(), here.end());
    }
    return faults;
  }

  Faults CheckItems(const json& schema, const json& value, const std::string& path) {
    Faults faults;
    if (!value.is_array()) return faults;
    for (size_t i = 0; i < value.size(); ++i) {
      const Faults here = Check(schema, value[i], fmt::format("{}/{}", path, i));
      faults.insert(faults.end(), here.begin(), here.end());
    }
    return faults;
  }

  static bool HasType(const std::string& type, const json& value) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    FENESTRA_CHECK(type == "integer", "unknown type " + type);
    return value.is_number_integer() ||
           (value.is_number() && value.get<double>() == std::floor(value.get<double>()));
  }

  static bool AreUnique(const json& array) {
    for (size_t i = 0; i < array.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        if (array[i] == array[j]) return false;
      }
    }
    return true;
  }

  static bool Holds(const std::string& word, const json& argument, const json& value) {
    if (word == "type") return HasType(argument.get<std::string>(), value);
    if (word == "const") return value == argument;
    if (word == "enum") return std::find(argument.begin(), argument.end(), value) != argument.end();
    if (word == "minimum") return !value.is_number() || value >= argument;
    if (word == "maximum") return !value.is_number() || value <= argument;
    if (word == "exclusiveMinimum") return !value.is_number() || value > argument;
    if (word == "minItems") return !value.is_array() || value.size() >= argument;
    if (word == "maxItems") return !value.is_array() || value.size() <= argument;
    if (word == "uniqueItems") return !value.is_array() || AreUnique(value);
    if (word == "minProperties") return !value.is_object() || value.size() >= argument;
    if (word == "maxProperties") return !value.is_object() || value.size() <= argument;
    if (word == "required") {
      return !value.is_object() || std::all_of(argument.begin(), argument.end(), [&](auto& key) {
        return value.contains(key.template get<std::string>());
      });
    }
    if (word == "pattern") {
      return !value.is_string() ||
             std::regex_search(value.get<std::string>(), std::regex(argument.get<std::string>()));
    }
    FENESTRA_CHECK(false, "unknown word " + word);
  }

  const json& root_;
};

json ScalarToJson(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;  // Quoted.
  if (text == "true" || text == "false") return text == "true";
  static const std::regex kInteger("[-+]?[0-9]{1,18}");
  static const std::regex kNumber(R"([-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?)");
  if (std::regex_match(text, kInteger)) return std::stoll(text);
  if (std::regex_match(text, kNumber)) return std::stod(text);
  return text;
}

}  // namespace

nlohmann::json ToJson(const YAML::Node& node) {
  if (node.IsScalar()) return ScalarToJson(node);
  if (node.IsSequence()) {
    json array = json::array();
    for (const YAML::Node& item : node) array.push_back(ToJson(item));
    return array;
  }
  if (!node.IsMap()) return nullptr;
  json object = json::object();
  for (const auto& entry : node) object[entry.first.Scalar()] = ToJson(entry.second);
  return object;
}

std::vector<std::string> SchemaFaults(const nlohmann::json& schema, const nlohmann::json& value) {
  return Validator(schema).Check(schema, value, "");
}

}  // namespace fenestra
