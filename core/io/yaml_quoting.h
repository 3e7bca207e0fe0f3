#pragma once

#include <string>

namespace fenestra {

/// The text as a double-quoted YAML scalar, whatever characters it has.
std::string YamlQuoted(const std::string& text);

}  // namespace fenestra
