// Detectors from shared libraries, as a user runs them. The library is tests/vision/plugins'.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/store/store.h"
#include "tests/experiments/cli/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::ReadFile;
using testing::TemporaryFolder;

const std::string kPlugin = " --plugin " FENESTRA_TEST_PLUGINS "/libplugin_none.so";

TEST(PluginTest, ACrashOrAHangInALibraryCostsItsTrialAndTheRestGoesOn) {
  const TemporaryFolder folder;
  const auto study = folder.Write(
      "plugin.yaml",
      "name: plugin\nrepetitions: 1\nsensors: [stereo]\nfactors: {distance_m: 1.5}\ndetectors:\n"
      "  - {name: test-detector, label: fine}\n"
      "  - {name: test-detector, label: chatty, options: {mode: print}}\n"
      "  - {name: test-detector, label: broken, options: {mode: segfault}}\n"
      "  - {name: test-detector, label: stuck, options: {mode: hang}, time_limit_s: 0.5}\n"
      "  - {name: test-detector, label: throwing, options: {mode: throw}}\n"
      "  - {name: test-detector, label: in-process, isolate: false}\n");
  const std::string out = (folder / "out").string();
  const ProgramOutput run = Fenestra("run " + study.string() + kPlugin + " --out " + out);
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const std::string rows = ReadFile(folder / "out/trials.csv");
  for (const char* bad : {",broken,crashed,died,it was ended by signal 11",
                          ",stuck,crashed,timeout,", ",throwing,crashed,exception,"}) {
    EXPECT_THAT(rows, HasSubstr(bad));
  }
  for (const char* good : {",fine,hit,", ",chatty,hit,", ",in-process,hit,"}) {
    EXPECT_THAT(rows, HasSubstr(good));
  }
  EXPECT_EQ(ResultStore::OpenReadOnly(folder / "out/results.sqlite")
                .Metadata()
                .at("plugins")
                .find("libplugin_none.so "),
            0u);
  EXPECT_EQ(Fenestra("replay " + out + " 0/0" + kPlugin).exit_code, 0);
  EXPECT_THAT(Fenestra("replay " + out + " 0/0").text, HasSubstr("unknown detector"));
}

TEST(PluginTest, ListsShowItAndWrongLibrariesAreRefused) {
  EXPECT_THAT(Fenestra("list detectors" + kPlugin).text,
              AllOf(HasSubstr("test-detector (stereo): For tests"), HasSubstr("depth_m")));
  ExpectRefused("list detectors --plugin /no/such/lib.so", "no such file", "");
  ExpectRefused("list detectors" + kPlugin + kPlugin, "one of that name already", "");
}

}  // namespace
}  // namespace fenestra
