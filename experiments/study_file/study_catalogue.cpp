#include "experiments/study_file/study_catalogue.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/faults.h"
#include "core/io/input_error.h"

namespace fenestra {

std::vector<std::string> BuiltInStudies() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(FENESTRA_STUDIES_DIR, error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path FindStudy(const std::string& name_or_path) {
  std::filesystem::path path(name_or_path);
  if (path.has_parent_path() || path.has_extension()) return path;
  const std::vector<std::string> names = BuiltInStudies();
  if (std::find(names.begin(), names.end(), name_or_path) != names.end()) {
    return std::filesystem::path(FENESTRA_STUDIES_DIR) / (name_or_path + ".yaml");
  }
  std::string hint = DidYouMean(name_or_path, names);
  if (hint.empty()) hint = fmt::format(" Known: {}.", fmt::join(names, ", "));
  throw InputError("", fmt::format("unknown study '{}'.{}", name_or_path, hint));
}

}  // namespace fenestra
