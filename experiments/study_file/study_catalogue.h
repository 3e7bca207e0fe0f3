#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fenestra {

/// Names of the studies that come with Fenestra, in alphabetical order.
std::vector<std::string> BuiltInStudies();

/// The file of a built-in study ("paper") or the path itself ("my/study.yaml": anything with a
/// folder or an extension). Throws InputError for a name that is not known.
std::filesystem::path FindStudy(const std::string& name_or_path);

}  // namespace fenestra
