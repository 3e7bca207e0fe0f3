#include "core/io/temporary_files.h"

#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using testing::ReadFile;
using testing::TemporaryFolder;

TEST(AtomicFileTest, WritesAndReplacesAndLeavesNothingElse) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder / "new/file", "one");
  WriteFileAtomically(folder / "new/file", std::string_view("t\0o", 3));
  EXPECT_EQ(ReadFile(folder / "new/file"), std::string("t\0o", 3));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "new"), {}), 1);
}

TEST(AtomicFileTest, AFolderInTheWayIsAnInputErrorAndStays) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "taken/inside");
  EXPECT_THROW(WriteFileAtomically(folder / "taken", "text"), InputError);
  EXPECT_TRUE(std::filesystem::is_directory(folder / "taken/inside"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace fenestra
