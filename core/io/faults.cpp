#include "core/io/faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

// Optimal string alignment distance: insertions, deletions, substitutions, adjacent swaps.
size_t EditDistance(std::string_view a, std::string_view b) {
  const size_t columns = b.size() + 1;
  std::vector<size_t> d((a.size() + 1) * columns);
  const auto at = [&d, columns](size_t i, size_t j) -> size_t& { return d[i * columns + j]; };
  for (size_t i = 0; i <= a.size(); ++i) at(i, 0) = i;
  for (size_t j = 0; j <= b.size(); ++j) at(0, j) = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
      }
    }
  }
  return at(a.size(), b.size());
}

}  // namespace

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

std::string DidYouMean(std::string_view word, std::span<const std::string> allowed) {
  if (word.size() > 64) return "";  // Nobody mistypes a name into that.
  const std::string* nearest = nullptr;
  size_t smallest = 0;
  for (const std::string& candidate : allowed) {
    const size_t distance = EditDistance(word, candidate);
    // A name typed without its unit ("distance" for "distance_m") is near as well.
    const bool prefix = word.size() >= 3 && candidate.starts_with(word);
    const size_t limit = std::max<size_t>(1, std::max(word.size(), candidate.size()) / 3);
    if (distance > limit && !prefix) continue;
    if (nearest == nullptr || distance < smallest) {
      nearest = &candidate;
      smallest = distance;
    }
  }
  return nearest == nullptr ? "" : " Did you mean '" + *nearest + "'?";
}

}  // namespace fenestra
