#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using Rules = std::map<std::string, std::set<std::string>>;

const std::filesystem::path kRoot = FENESTRA_SOURCE_DIR;

// Rows such as: | 1 | `vision` | the detectors ... | core |
Rules ReadRules(const std::string& markdown) {
  Rules rules;
  std::istringstream lines(markdown);
  const std::regex row(R"(^\|[^|]*\| `(\w+)` \|.*\| ([^|]*) \|$)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    std::set<std::string>& allowed = rules[match[1]];
    allowed.insert(match[1]);
    std::istringstream names(match[2]);
    for (std::string name; std::getline(names, name, ',');) {
      name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
      if (name != "–") allowed.insert(name);
    }
  }
  return rules;
}

// "file includes x/y.h" for every include that the rules do not allow.
std::vector<std::string> Violations(const Rules& rules, const std::string& folder,
                                    const std::string& file, const std::string& text) {
  std::vector<std::string> violations;
  const std::regex include("#include \"([^/\"]+)(/[^\"]*)?\"");
  for (auto i = std::sregex_iterator(text.begin(), text.end(), include);
       i != std::sregex_iterator(); ++i) {
    const std::string target = (*i)[1];
    const bool known = rules.contains(target) && (*i)[2].matched;
    if (!known || !rules.at(folder).contains(target)) {
      violations.push_back(file + " has " + i->str());
    }
  }
  return violations;
}

Rules ProjectRules() {
  return ReadRules(testing::ReadFile(kRoot / "docs/architecture.md"));
}

TEST(IncludeDirectionTest, TheTableNamesEveryFolderOfSources) {
  const Rules rules = ProjectRules();
  for (const auto& entry : std::filesystem::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename();
    const std::set<std::string> others = {"build", "cmake", "docs", "examples", "results"};
    if (!entry.is_directory() || name.starts_with(".") || others.contains(name)) continue;
    EXPECT_TRUE(rules.contains(name)) << name;
  }
}

TEST(IncludeDirectionTest, IncludesGoDownTheFloorsOnly) {
  const Rules rules = ProjectRules();
  ASSERT_EQ(rules.at("vision"), (std::set<std::string>{"core", "vision"}));
  size_t files = 0;
  for (const auto& [folder, allowed] : rules) {
    ASSERT_TRUE(allowed.contains(folder));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      ++files;
      const std::string text = testing::ReadFile(entry.path());
      for (const std::string& violation : Violations(rules, folder, entry.path().string(), text)) {
        ADD_FAILURE() << violation;
      }
    }
  }
  EXPECT_GT(files, 100u);
}

TEST(IncludeDirectionTest, AForbiddenIncludeIsFound) {
  const Rules rules = ProjectRules();
  EXPECT_EQ(Violations(rules, "vision", "f", "#include \"sim/stereo/stereo_rig.h\"\n").size(), 1u);
  EXPECT_EQ(Violations(rules, "core", "f", "#include \"scenes/scene.h\"\n").size(), 1u);
  EXPECT_EQ(Violations(rules, "core", "f", "#include \"pose.h\"\n").size(), 1u);
  EXPECT_TRUE(
      Violations(rules, "sim", "f", "#include \"core/geometry/pose.h\"\n#include <map>\n").empty());
}

}  // namespace
}  // namespace fenestra
