#include "core/io/faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fenestra {

void Faults::AddFault(InputFault fault) {
  if (faults_.size() == most_reported_) {
    ++left_out_;
    return;
  }
  if (fault.source.empty()) fault.source = source_;
  faults_.push_back(std::move(fault));
}

void Faults::Add(std::string_view place, std::string_view message) {
  Add(place.empty() ? std::string(message) : fmt::format("{}: {}", place, message));
}

void Faults::Add(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) Add(message);
}

void Faults::RequirePositive(std::string_view name, double value) {
  Require(std::isfinite(value) && value > 0.0,
          fmt::format("{} must be positive, not {}", name, value));
}

void Faults::RequireNotNegative(std::string_view name, double value) {
  Require(std::isfinite(value) && value >= 0.0,
          fmt::format("{} must be 0 or more, not {}", name, value));
}

void Faults::RequireWithin(std::string_view name, double value, double min, double max) {
  Require(value >= min && value <= max,
          fmt::format("{} must be in [{}, {}], not {}", name, min, max, value));
}

void Faults::SortByPlace() {
  std::stable_sort(faults_.begin(), faults_.end(), [](const InputFault& a, const InputFault& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
}

void Faults::ThrowIfAny() const {
  if (faults_.empty()) return;
  std::vector<InputFault> reported = faults_;
  if (left_out_ > 0) {
    reported.push_back(
        {.source = source_, .message = fmt::format("and {} more faults", left_out_)});
  }
  throw InputError(std::move(reported));
}

}  // namespace fenestra
