#include "scenes/gltf/reader/notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace fenestra::gltf {

void Notes::Add(std::string_view what, std::string thing) {
  auto found = std::ranges::find(things_by_what_, what,
                                 [](const auto& entry) { return std::string_view(entry.first); });
  if (found == things_by_what_.end()) {
    found = things_by_what_.insert(found, {std::string(what), {}});
  }
  std::vector<std::string>& things = found->second;
  if (things.empty() || things.back() != thing) things.push_back(std::move(thing));
}

std::vector<std::string> Notes::Sentences() const {
  constexpr size_t kMostNamed = 3;
  std::vector<std::string> sentences;
  for (const auto& [what, things] : things_by_what_) {
    const size_t named = std::min(things.size(), kMostNamed);
    std::string subject = fmt::format(
        "{}", fmt::join(things.begin(), things.begin() + static_cast<int>(named), ", "));
    if (things.size() > named) subject += fmt::format(" and {} more", things.size() - named);
    sentences.push_back(fmt::format("{}: {}", subject, what));
  }
  return sentences;
}

std::string Named(std::string_view kind, std::string_view name, size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}'", kind, name);
}

}  // namespace fenestra::gltf
