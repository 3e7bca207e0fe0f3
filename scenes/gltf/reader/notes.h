#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace fenestra::gltf {

/// Gathers what a reader leaves out or approximates: one sentence for each kind, with the things
/// that it happened to.
class Notes {
 public:
  /// `what` is the rest of a sentence that begins with the thing's name.
  void Add(std::string_view what, std::string thing);

  /// "material 'a', material 'b' and 7 more: <what>", in the order of what was added first.
  std::vector<std::string> Sentences() const;

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> things_by_what_;
};

/// "material 'paint'", or "material 3" where it has no name.
std::string Named(std::string_view kind, std::string_view name, size_t index);

}  // namespace fenestra::gltf
