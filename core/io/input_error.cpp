#include "core/io/input_error.h"

#include <fmt/format.h>

namespace fenestra {
namespace {

std::string JoinLines(const std::vector<InputFault>& faults) {
  std::string text;
  for (const InputFault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += fault.ToString();
  }
  return text;
}

}  // namespace

std::string InputFault::ToString() const {
  std::string where = source;
  if (line > 0) where += fmt::format(":{}", line);
  if (line > 0 && column > 0) where += fmt::format(":{}", column);
  return where.empty() ? message : where + ": " + message;
}

InputError::InputError(std::vector<InputFault> faults)
    : std::runtime_error(JoinLines(faults)), faults_(std::move(faults)) {}

InputError::InputError(const std::filesystem::path& source, const std::string& message)
    : InputError(std::vector<InputFault>{{source.string(), 0, 0, message}}) {}

}  // namespace fenestra
