#include "core/io/did_you_mean.h"

#include <algorithm>
#include <vector>

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
