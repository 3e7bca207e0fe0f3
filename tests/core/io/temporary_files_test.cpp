#include "core/io/temporary_files.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "core/io/input_error.h"
#include "core/io/system_error.h"
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

// Two of one process stand for two processes that do not see each other's numbers.
TEST(PrivateFolderTest, OneInUseStaysWhenAnotherIsMade) {
  const PrivateFolder first;
  const PrivateFolder second;
  first.RequireThere();
  second.RequireThere();
  EXPECT_NE(first.path(), second.path());
  const auto others = std::filesystem::perms::group_all | std::filesystem::perms::others_all;
  EXPECT_EQ(std::filesystem::status(first.path()).permissions() & others,
            std::filesystem::perms::none);
}

TEST(PrivateFolderTest, WhatAKilledProcessLeftIsRemoved) {
  std::array<int, 2> told{};
  ASSERT_EQ(pipe(told.data()), 0);
  const pid_t child = fork();
  if (child == 0) {
    const PrivateFolder left;
    WriteFileAtomically(left.path() / "left.png", "left");
    const std::string path = left.path().string();
    _exit(write(told[1], path.data(), path.size()) > 0 ? 0 : 1);
  }
  std::string path(200, '\0');
  path.resize(static_cast<size_t>(read(told[0], path.data(), path.size())));
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(std::filesystem::exists(std::filesystem::path(path) / "left.png"));
  const PrivateFolder next;
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(PrivateFolderTest, OneThatOthersRemovedIsAFailureOfTheMachine) {
  const PrivateFolder folder;
  std::filesystem::remove_all(folder.path());
  EXPECT_THROW(folder.RequireThere(), SystemError);
  std::filesystem::create_directory(folder.path());  // By somebody else.
  EXPECT_THROW(folder.RequireThere(), SystemError);
  std::filesystem::remove(folder.path());
}

}  // namespace
}  // namespace fenestra
