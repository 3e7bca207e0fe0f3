#pragma once

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fenestra {

/// YAML as JSON by the types of YAML's core schema: what an editor's validator sees.
nlohmann::json ToJson(const YAML::Node& node);

/// How `value` breaks the schema, as "/path: reason"; empty if it does not. Knows the words of JSON
/// Schema draft 07 that schemas of studies use, and throws std::logic_error for any other word, so
/// that none goes unheeded.
std::vector<std::string> SchemaFaults(const nlohmann::json& schema, const nlohmann::json& value);

}  // namespace fenestra
