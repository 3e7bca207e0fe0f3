#include "core/io/yaml_quoting.h"

#include <yaml-cpp/yaml.h>

namespace fenestra {

std::string YamlQuoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

}  // namespace fenestra
