#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace fenestra {

/// A C++ file as the rules of the layout see it. All paths are relative to the root of the
/// repository and have forward slashes, as includes are written.
struct SourceFile {
  std::string path;
  int lines = 0;
  /// What it includes in quotation marks, as written.
  std::vector<std::string> includes;
};

SourceFile ParseSource(const std::string& path, const std::string& text);

/// Every .h and .cpp below the given folders of the repository, sorted by path.
std::vector<SourceFile> ReadSources(const std::filesystem::path& root,
                                    const std::vector<std::string>& folders);

/// The unit that a file belongs to: its path without the extension, so that a header and its
/// source are one.
std::string UnitOf(const std::string& path);

/// The folder that directly holds a file or a unit.
std::string FolderOf(const std::string& path);

/// Which nodes each node depends on, itself and nodes outside of the graph left out.
using DependencyGraph = std::map<std::string, std::set<std::string>>;

DependencyGraph UnitGraph(const std::vector<SourceFile>& sources);
DependencyGraph FolderGraph(const std::vector<SourceFile>& sources);

/// Circles of the graph, each as "a -> b -> a". None exactly if the graph has no circle. Of circles
/// that share a dependency one is given: whoever opens it sees the next.
std::vector<std::string> Circles(DependencyGraph graph);

}  // namespace fenestra
