#include "tests/architecture/source_tree.h"

#include <algorithm>
#include <sstream>

#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

// The graph over what `node_of` makes of a path: its unit or its folder.
template <typename NodeOf>
DependencyGraph GraphOver(const std::vector<SourceFile>& sources, NodeOf node_of) {
  DependencyGraph graph;
  for (const SourceFile& file : sources) graph[node_of(file.path)];
  for (const SourceFile& file : sources) {
    const std::string node = node_of(file.path);
    for (const std::string& include : file.includes) {
      const std::string target = node_of(include);
      if (target != node && graph.contains(target)) graph.at(node).insert(target);
    }
  }
  return graph;
}

// Takes away, again and again, nodes that depend on nothing that is left: they are in no circle.
DependencyGraph WithoutLeaves(DependencyGraph graph) {
  const auto is_leaf = [](const auto& node) { return node.second.empty(); };
  for (;;) {
    const auto leaf = std::find_if(graph.begin(), graph.end(), is_leaf);
    if (leaf == graph.end()) return graph;
    const std::string name = leaf->first;
    graph.erase(leaf);
    for (auto& [other, targets] : graph) targets.erase(name);
  }
}

// The nodes of one circle in their order, or none. In a graph without leaves a walk can always go
// on, so that it comes back to a node where it was.
std::vector<std::string> AnyCircle(const DependencyGraph& graph) {
  const DependencyGraph rest = WithoutLeaves(graph);
  if (rest.empty()) return {};
  std::vector<std::string> walk = {rest.begin()->first};
  for (;;) {
    const std::string& next = *rest.at(walk.back()).begin();
    const auto before = std::find(walk.begin(), walk.end(), next);
    if (before != walk.end()) return {before, walk.end()};
    walk.push_back(next);
  }
}

}  // namespace

SourceFile ParseSource(const std::string& path, const std::string& text) {
  SourceFile file{.path = path, .lines = 0, .includes = {}};
  const std::string opening = "#include \"";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line); ++file.lines) {
    if (!line.starts_with(opening)) continue;
    const size_t end = line.find('"', opening.size());
    file.includes.push_back(line.substr(opening.size(), end - opening.size()));
  }
  return file;
}

std::vector<SourceFile> ReadSources(const std::filesystem::path& root,
                                    const std::vector<std::string>& folders) {
  std::vector<SourceFile> sources;
  for (const std::string& folder : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      sources.push_back(ParseSource(entry.path().lexically_relative(root).generic_string(),
                                    testing::ReadFile(entry.path())));
    }
  }
  std::sort(sources.begin(), sources.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return sources;
}

std::string UnitOf(const std::string& path) {
  return std::filesystem::path(path).replace_extension().generic_string();
}

std::string FolderOf(const std::string& path) {
  return std::filesystem::path(path).parent_path().generic_string();
}

DependencyGraph UnitGraph(const std::vector<SourceFile>& sources) {
  return GraphOver(sources, UnitOf);
}

DependencyGraph FolderGraph(const std::vector<SourceFile>& sources) {
  return GraphOver(sources, FolderOf);
}

std::vector<std::string> Circles(DependencyGraph graph) {
  std::vector<std::string> circles;
  for (;;) {
    const std::vector<std::string> circle = AnyCircle(graph);
    if (circle.empty()) return circles;
    std::string text;
    for (const std::string& node : circle) text += node + " -> ";
    circles.push_back(text + circle.front());
    graph.at(circle.back()).erase(circle.front());
  }
}

}  // namespace fenestra
