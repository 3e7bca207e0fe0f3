#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"
#include "tests/support/temporary_folder.h"

// The folder is the concept, the file its main type, the test file its mirror. Each rule has a twin
// that breaks it on a made-up tree.

namespace fenestra {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const std::filesystem::path kRepository = FENESTRA_SOURCE_DIR;

// More than somebody can hold in mind while looking for a thing.
constexpr size_t kMostUnitsOfAFolder = 25;
// One idea a file: the few that are longer hold tables.
constexpr int kLongFile = 300;
constexpr double kLongFilesQuantile = 0.9;
// Shorter files are fragments of an idea that is told elsewhere, or an interface of few words.
constexpr int kShortFile = 40;
constexpr double kMostShortFiles = 0.15;
// A file of typical length has 80 to 200 lines; from here on a source is worth a test of its own.
constexpr int kSourceOfWeight = 150;

std::vector<SourceFile> ProductSources() {
  return ReadSources(kRepository, {"core", "vision", "scenes", "renderers", "sim", "experiments"});
}

std::set<std::string> Paths(const std::vector<SourceFile>& sources) {
  std::set<std::string> paths;
  for (const SourceFile& file : sources) paths.insert(file.path);
  return paths;
}

std::vector<std::string> CrowdedFolders(const std::vector<SourceFile>& sources) {
  std::map<std::string, std::set<std::string>> units;
  for (const SourceFile& file : sources) units[FolderOf(file.path)].insert(UnitOf(file.path));
  std::vector<std::string> crowded;
  for (const auto& [folder, names] : units) {
    if (names.size() <= kMostUnitsOfAFolder) continue;
    crowded.push_back(folder + " has " + std::to_string(names.size()) + " units");
  }
  return crowded;
}

// The length that the given share of the files does not exceed.
int LengthQuantile(const std::vector<SourceFile>& sources, double share) {
  std::vector<int> lengths;
  for (const SourceFile& file : sources) lengths.push_back(file.lines);
  const auto rank = lengths.begin() + static_cast<ptrdiff_t>(share * (lengths.size() - 1));
  std::nth_element(lengths.begin(), rank, lengths.end());
  return *rank;
}

double ShareOfShortFiles(const std::vector<SourceFile>& sources) {
  const auto is_short = [](const SourceFile& file) { return file.lines < kShortFile; };
  return static_cast<double>(std::count_if(sources.begin(), sources.end(), is_short)) /
         static_cast<double>(sources.size());
}

// "a/b/name.cpp" is tested by "tests/a/b/name_test.cpp".
std::vector<std::string> UntestedSourcesOfWeight(const std::vector<SourceFile>& sources,
                                                 const std::set<std::string>& tests) {
  std::vector<std::string> untested;
  for (const SourceFile& file : sources) {
    if (!file.path.ends_with(".cpp") || file.lines < kSourceOfWeight) continue;
    if (!tests.contains("tests/" + UnitOf(file.path) + "_test.cpp")) untested.push_back(file.path);
  }
  return untested;
}

std::vector<std::string> FilesDirectlyIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.is_directory()) names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

SourceFile OfLines(const std::string& path, int lines) {
  return {.path = path, .lines = lines, .includes = {}};
}

TEST(LayoutTest, UnitsDoNotIncludeEachOtherInACircle) {
  const std::vector<SourceFile> sources = ProductSources();
  ASSERT_GT(sources.size(), 100u);
  EXPECT_THAT(Circles(UnitGraph(sources)), IsEmpty());
}

TEST(LayoutTest, ACircleOfUnitsIsFoundThroughHeadersAndSources) {
  const std::vector<SourceFile> sources = {
      ParseSource("a/one.h", "#include \"a/two.h\"\n"), ParseSource("a/two.h", "#include <map>\n"),
      ParseSource("a/two.cpp", "#include \"a/two.h\"\n\n#include \"b/three.h\"\n"),
      ParseSource("b/three.h", "#include \"a/one.h\"\n"),
      ParseSource("b/four.h", "#include \"a/one.h\"\n#include \"b/three.h\"\n")};
  EXPECT_THAT(Circles(UnitGraph(sources)), ElementsAre("a/one -> a/two -> b/three -> a/one"));
}

TEST(LayoutTest, FoldersDoNotIncludeEachOtherInACircle) {
  EXPECT_THAT(Circles(FolderGraph(ProductSources())), IsEmpty());
}

TEST(LayoutTest, ACircleOfFoldersIsFoundWhereUnitsHaveNone) {
  const std::vector<SourceFile> sources = {ParseSource("a/face.h", "#include \"a/b/part.h\"\n"),
                                           ParseSource("a/b/part.h", "#include \"a/type.h\"\n"),
                                           ParseSource("a/type.h", "")};
  EXPECT_THAT(Circles(UnitGraph(sources)), IsEmpty());
  EXPECT_THAT(Circles(FolderGraph(sources)), ElementsAre("a -> a/b -> a"));
}

TEST(LayoutTest, EveryCircleThatIsLeftIsNamed) {
  const DependencyGraph graph = {{"a", {"b"}}, {"b", {"a", "c"}}, {"c", {"d"}}, {"d", {"c"}}};
  EXPECT_THAT(Circles(graph), ElementsAre("a -> b -> a", "c -> d -> c"));
}

TEST(LayoutTest, NoFolderIsCrowded) {
  EXPECT_THAT(CrowdedFolders(ProductSources()), IsEmpty());
}

TEST(LayoutTest, AFolderOfOneUnitTooManyIsCrowded) {
  std::vector<SourceFile> sources;
  for (size_t i = 0; i < kMostUnitsOfAFolder; ++i) {
    sources.push_back(OfLines("a/unit" + std::to_string(i) + ".h", 80));
    sources.push_back(OfLines("a/unit" + std::to_string(i) + ".cpp", 80));
  }
  sources.push_back(OfLines("a/b/one.h", 80));
  EXPECT_THAT(CrowdedFolders(sources), IsEmpty());
  sources.push_back(OfLines("a/one_more.h", 80));
  EXPECT_THAT(CrowdedFolders(sources), ElementsAre("a has 26 units"));
}

TEST(LayoutTest, FilesAreNeitherLongNorFragments) {
  const std::vector<SourceFile> sources = ProductSources();
  EXPECT_LT(LengthQuantile(sources, kLongFilesQuantile), kLongFile);
  EXPECT_LT(ShareOfShortFiles(sources), kMostShortFiles);
}

TEST(LayoutTest, LongFilesAndFragmentsAreCounted) {
  std::vector<SourceFile> sources;
  for (int i = 0; i < 8; ++i) sources.push_back(OfLines("a.h", 100));
  sources.push_back(OfLines("fragment.h", kShortFile - 1));
  sources.push_back(OfLines("long.cpp", kLongFile));
  EXPECT_LT(LengthQuantile(sources, kLongFilesQuantile), kLongFile);
  EXPECT_LT(ShareOfShortFiles(sources), kMostShortFiles);
  sources[0].lines = kLongFile;
  sources[1].lines = kShortFile - 1;
  EXPECT_GE(LengthQuantile(sources, kLongFilesQuantile), kLongFile);
  EXPECT_GE(ShareOfShortFiles(sources), kMostShortFiles);
}

TEST(LayoutTest, SourcesOfWeightHaveATestOfTheirName) {
  const std::set<std::string> tests = Paths(ReadSources(kRepository, {"tests"}));
  EXPECT_THAT(UntestedSourcesOfWeight(ProductSources(), tests), IsEmpty());
}

TEST(LayoutTest, ASourceOfWeightWhoseTestStandsElsewhereIsNamed) {
  const std::vector<SourceFile> sources = {
      OfLines("a/b/tested.cpp", kSourceOfWeight), OfLines("a/b/table.h", kSourceOfWeight),
      OfLines("a/b/light.cpp", kSourceOfWeight - 1), OfLines("a/b/heavy.cpp", kSourceOfWeight)};
  const std::set<std::string> tests = {"tests/a/b/tested_test.cpp", "tests/a/heavy_test.cpp",
                                       "tests/a/b/heavy.cpp"};
  EXPECT_THAT(UntestedSourcesOfWeight(sources, tests), ElementsAre("a/b/heavy.cpp"));
}

TEST(LayoutTest, ExperimentsHasFoldersOnly) {
  EXPECT_THAT(FilesDirectlyIn(kRepository / "experiments"), ElementsAre("CMakeLists.txt"));
}

TEST(LayoutTest, AFileBesideTheFoldersIsFound) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "inner");
  folder.Write("CMakeLists.txt", "add_subdirectory(inner)\n");
  folder.Write("stray.h", "");
  EXPECT_THAT(FilesDirectlyIn(folder.path()), ElementsAre("CMakeLists.txt", "stray.h"));
}

TEST(LayoutTest, SourcesAreReadWithTheirLengthsAndIncludes) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a/b");
  folder.Write("a/b/inside.h", "#include <map>\n#include \"a/one.h\"\n\n// #include \"a/two.h\"\n");
  folder.Write("a/b/notes.txt", "#include \"a/one.h\"\n");
  folder.Write("a/one.h", "\n");
  folder.Write("two.h", "\n");
  const std::vector<SourceFile> sources = ReadSources(folder.path(), {"a"});
  ASSERT_THAT(sources, SizeIs(2));
  EXPECT_EQ(sources[0].path, "a/b/inside.h");
  EXPECT_EQ(sources[0].lines, 4);
  EXPECT_THAT(sources[0].includes, ElementsAre("a/one.h"));
  EXPECT_EQ(sources[1].path, "a/one.h");
}

}  // namespace
}  // namespace fenestra
