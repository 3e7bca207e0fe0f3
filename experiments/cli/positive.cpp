#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "experiments/cli/commands.h"

namespace fenestra::cli {

CLI::Validator Positive() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        double value = 0.0;
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        const bool is_number = read.ec == std::errc() && read.ptr == end;
        if (is_number && std::isfinite(value) && value > 0.0) return {};
        return fmt::format("'{}' is not a positive number", text);
      },
      "POSITIVE");
}

}  // namespace fenestra::cli
