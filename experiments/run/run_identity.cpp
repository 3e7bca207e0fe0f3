#include "experiments/run/run_identity.h"

#include <fmt/format.h>
#include <pcl/pcl_config.h>
#include <sqlite3.h>

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <opencv2/core/utility.hpp>
#include <openturns/PlatformInfo.hxx>
#include <sstream>

#include "core/system/program.h"
#include "experiments/study_file/study_writer.h"
#include "renderers/tracing/embree_scene.h"
#include "vision/plugin_loader.h"

namespace fenestra {
namespace {

constexpr size_t kMostLines = 3;  // The first differing lines of a study show what was changed.

// The lines that rows depend on, each with the name of its part: "near: distance_m: [1.4, 2]".
std::vector<std::string> LinesOf(const std::string& yaml) {
  std::vector<std::string> lines;
  std::istringstream stream(yaml);
  std::string part;
  for (std::string line; std::getline(stream, line);) {
    const size_t begin = line.find_first_not_of(" -");
    if (begin == std::string::npos || line[begin] == '#') continue;
    if (line.starts_with("fenestra_version:") || line.starts_with("description:")) continue;
    if (line.starts_with("  - name: ")) part = line.substr(10) + ": ";
    lines.push_back(part + line.substr(begin));
  }
  return lines;
}

// Lines of `a` that `b` does not have as often.
std::vector<std::string> Without(const std::vector<std::string>& a,
                                 const std::vector<std::string>& b) {
  std::map<std::string, int> counts;
  for (const std::string& line : b) ++counts[line];
  std::vector<std::string> rest;
  for (const std::string& line : a) {
    if (--counts[line] < 0) rest.push_back(line);
  }
  return rest;
}

std::string Text(const std::vector<std::string>& lines) {
  if (lines.empty()) return "nothing of the kind";
  const auto end = lines.begin() + static_cast<long>(std::min(lines.size(), kMostLines));
  std::string text = fmt::format("'{}'", fmt::join(lines.begin(), end, "', '"));
  if (lines.size() > kMostLines) text += fmt::format(" and {} more", lines.size() - kMostLines);
  return text;
}

std::string Plugins() {
  std::vector<std::string> plugins;
  for (const LoadedPlugin& plugin : LoadedPlugins()) {
    plugins.push_back(fmt::format("{} {}", plugin.name, plugin.build_id));
  }
  std::sort(plugins.begin(), plugins.end());
  return fmt::format("{}", fmt::join(plugins, ", "));
}

}  // namespace

RunIdentity IdentityOf(const Study& study) {
  return {.study = ToYaml(study),
          .version = Version(),
          .build = BuildId(),
          .libraries = LibraryVersions(),
          .instruction_set = WidestInstructionSet(),
          .plugins = Plugins()};
}

void AddTo(StoreMetadata& metadata, const RunIdentity& identity) {
  metadata["study"] = identity.study;
  metadata["version"] = identity.version;
  metadata["build"] = identity.build;
  metadata["libraries"] = identity.libraries;
  metadata["instruction_set"] = identity.instruction_set;
  metadata["plugins"] = identity.plugins;
}

RunIdentity IdentityFrom(const StoreMetadata& metadata) {
  const auto get = [&metadata](const char* key) {
    const auto found = metadata.find(key);
    return found == metadata.end() ? std::string() : found->second;
  };
  return {.study = get("study"),
          .version = get("version"),
          .build = get("build"),
          .libraries = get("libraries"),
          .instruction_set = get("instruction_set"),
          .plugins = get("plugins")};
}

std::vector<std::string> Differences(const RunIdentity& there, const RunIdentity& here) {
  std::vector<std::string> differences;
  const auto compare = [&](const char* what, const std::string& a, const std::string& b) {
    if (a != b) differences.push_back(fmt::format("{}: {} there, {} here", what, a, b));
  };
  compare("version", there.version, here.version);
  if (there.version == here.version) compare("build", there.build, here.build);
  compare("libraries", there.libraries, here.libraries);
  compare("instruction set", there.instruction_set, here.instruction_set);
  compare("plugins", there.plugins, here.plugins);
  if (there.study != here.study) {
    const std::vector<std::string> a = LinesOf(there.study);
    const std::vector<std::string> b = LinesOf(here.study);
    if (a != b) compare("study", Text(Without(a, b)), Text(Without(b, a)));
  }
  return differences;
}

std::string LibraryVersions() {
  return fmt::format("Embree {}, OpenCV {}, PCL {}, Eigen {}.{}.{}, SQLite {}, OpenTURNS {}",
                     EmbreeVersion(), cv::getVersionString(), PCL_VERSION_PRETTY,
                     EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
                     sqlite3_libversion(), OT::PlatformInfo::GetVersion());
}

}  // namespace fenestra
