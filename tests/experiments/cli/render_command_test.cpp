#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/experiments/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::ReadFile;
using testing::TemporaryFolder;

const std::string kModel = FENESTRA_SOURCE_DIR "/tests/data/gltf/samples/Box/glTF/Box.gltf";

TEST(RenderCommandTest, ASceneIsRefusedWithWhatItWouldNeed) {
  const TemporaryFolder folder;
  const std::string out = " --out " + (folder / "out").string();
  const ProgramOutput large = Fenestra("render " + kModel + " --memory-gb 1e-9" + out);
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_THAT(large.text, AllOf(HasSubstr("would need about"), HasSubstr("the limit is")));
  const ProgramOutput slow = Fenestra("render " + kModel + " --seconds 1e-9" + out);
  EXPECT_EQ(slow.exit_code, 2);
  EXPECT_THAT(slow.text, HasSubstr("--seconds"));
  for (const char* senseless : {"0", "-1", "nan"}) {
    EXPECT_EQ(Fenestra("render " + kModel + " --memory-gb " + senseless + out).exit_code, 2)
        << senseless;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace fenestra
