#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"
#include "tests/support/temporary_folder.h"

// The table of folders in docs/architecture.md is the law: every folder of sources has a row, a row
// names what its folder may include, and it names only what stands above it.

namespace fenestra {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const std::filesystem::path kRoot = FENESTRA_SOURCE_DIR;

struct Row {
  std::string folder;
  std::vector<std::string> may_include;
};

// What a name in a folder's row stands for: that folder, and if it is another top-level folder, all
// that is below it, too.
bool Covers(const std::string& name, const std::string& folder, const std::string& row) {
  if (folder == name) return true;
  return !row.starts_with(name + "/") && name.find('/') == std::string::npos &&
         folder.starts_with(name + "/");
}

// Rows such as: | `sim/camera` | lens, image sensor | core, renderers, sim/motion |
std::vector<Row> ReadTable(const std::string& markdown) {
  std::vector<Row> rows;
  std::istringstream lines(markdown);
  const std::regex pattern(R"(^\| `([\w/]+)` \|.*\| ([^|]*) \|$)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, pattern)) continue;
    Row row{.folder = match[1], .may_include = {}};
    std::istringstream names(match[2]);
    for (std::string name; std::getline(names, name, ',');) {
      name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
      if (name != "–") row.may_include.push_back(name);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

// The row of the folder that holds a file, or of the nearest one above it; null without one.
const Row* RowOf(const std::vector<Row>& table, const std::string& path) {
  const Row* nearest = nullptr;
  for (const Row& row : table) {
    if (!path.starts_with(row.folder + "/")) continue;
    if (nearest == nullptr || row.folder.size() > nearest->folder.size()) nearest = &row;
  }
  return nearest;
}

bool MayInclude(const Row& from, const Row& to) {
  const auto covers = [&](const std::string& name) { return Covers(name, to.folder, from.folder); };
  return &from == &to || std::any_of(from.may_include.begin(), from.may_include.end(), covers);
}

// "file includes x/y.h" for every include that the table does not allow.
std::vector<std::string> Violations(const std::vector<Row>& table,
                                    const std::vector<SourceFile>& sources) {
  std::vector<std::string> violations;
  for (const SourceFile& file : sources) {
    const Row* from = RowOf(table, file.path);
    for (const std::string& target : file.includes) {
      const Row* to = RowOf(table, target);
      if (from != nullptr && to != nullptr && MayInclude(*from, *to)) continue;
      violations.push_back(file.path + " includes " + target);
    }
  }
  return violations;
}

// "a names b" for every entry that is not above its row: such a table allows a circle.
std::vector<std::string> EntriesNotAbove(const std::vector<Row>& table) {
  std::vector<std::string> entries;
  for (size_t i = 0; i < table.size(); ++i) {
    for (const std::string& name : table[i].may_include) {
      const auto covered = [&](const Row& row) {
        return Covers(name, row.folder, table[i].folder);
      };
      const auto here = table.begin() + static_cast<ptrdiff_t>(i);
      const bool any_above = std::any_of(table.begin(), here, covered);
      const bool any_below = std::any_of(here, table.end(), covered);
      if (!any_above || any_below) entries.push_back(table[i].folder + " names " + name);
    }
  }
  return entries;
}

std::vector<std::string> FoldersWithoutRow(const std::vector<Row>& table,
                                           const std::vector<SourceFile>& sources) {
  std::vector<std::string> folders;
  for (const SourceFile& file : sources) {
    const std::string folder = FolderOf(file.path);
    const Row* row = RowOf(table, file.path);
    const bool has_row = row != nullptr && (row->folder == folder || row->folder == "tests");
    if (!has_row && std::find(folders.begin(), folders.end(), folder) == folders.end()) {
      folders.push_back(folder);
    }
  }
  return folders;
}

std::vector<Row> ProjectTable() {
  return ReadTable(testing::ReadFile(kRoot / "docs/architecture.md"));
}

std::vector<SourceFile> ProjectSources() {
  // Not of the tree of libraries: examples stand for themselves, as a user's own programs do.
  const std::set<std::string> others = {"build", "cmake", "examples"};
  std::vector<std::string> folders;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename();
    if (entry.is_directory() && !name.starts_with(".") && !others.contains(name)) {
      folders.push_back(name);
    }
  }
  return ReadSources(kRoot, folders);
}

TEST(IncludeDirectionTest, EveryFolderOfSourcesHasItsRow) {
  EXPECT_THAT(FoldersWithoutRow(ProjectTable(), ProjectSources()), IsEmpty());
}

TEST(IncludeDirectionTest, AFolderWithoutARowIsFound) {
  const std::vector<Row> table = ReadTable("| `sim` | sensors | – |\n| `tests` | tests | sim |\n");
  const std::vector<SourceFile> sources = {
      ParseSource("sim/lens.h", ""), ParseSource("sim/camera/lens.h", ""),
      ParseSource("utils/all.h", ""), ParseSource("tests/sim/camera/lens_test.cpp", "")};
  EXPECT_THAT(FoldersWithoutRow(table, sources), ElementsAre("sim/camera", "utils"));
}

TEST(IncludeDirectionTest, RowsNameOnlyWhatStandsAboveThem) {
  const std::vector<Row> table = ProjectTable();
  ASSERT_GT(table.size(), 50u);
  EXPECT_THAT(EntriesNotAbove(table), IsEmpty());
}

TEST(IncludeDirectionTest, ARowThatNamesWhatIsBelowOrMissingIsFound) {
  const std::vector<Row> table = ReadTable(
      "| `core/io` | files | core/geometry, nowhere |\n"
      "| `core/geometry` | poses | core/io |\n"
      "| `sim` | sensors | core, sim |\n");
  EXPECT_THAT(EntriesNotAbove(table),
              ElementsAre("core/io names core/geometry", "core/io names nowhere", "sim names sim"));
}

TEST(IncludeDirectionTest, IncludesAreThoseThatTheTableAllows) {
  const std::vector<SourceFile> sources = ProjectSources();
  ASSERT_GT(sources.size(), 500u);
  EXPECT_THAT(Violations(ProjectTable(), sources), IsEmpty());
}

TEST(IncludeDirectionTest, AForbiddenIncludeIsFoundWhateverTheDepthOfItsFolder) {
  const std::vector<Row> table = ProjectTable();
  const auto violations = [&table](const std::string& file, const std::string& target) {
    return Violations(table, {ParseSource(file, "#include \"" + target + "\"\n")});
  };
  EXPECT_THAT(violations("vision/frame/f.h", "sim/stereo/stereo_rig.h"), SizeIs(1));
  EXPECT_THAT(violations("core/io/f.h", "core/detection/detector.h"), SizeIs(1));
  EXPECT_THAT(violations("vision/rgbd/paper/f.h", "vision/rgbd/plane/plane_rgbd.h"), SizeIs(1));
  EXPECT_THAT(violations("renderers/tracing/f.h", "renderers/ray_caster.h"), SizeIs(1));
  EXPECT_THAT(violations("core/geometry/f.h", "pose.h"), SizeIs(1));
  EXPECT_THAT(violations("sim/camera/f.h", "core/geometry/pose.h"), IsEmpty());
  EXPECT_THAT(violations("tests/sim/camera/f.cpp", "sim/camera/lens.h"), IsEmpty());
}

}  // namespace
}  // namespace fenestra
