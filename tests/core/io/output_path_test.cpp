#include "core/io/output_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/io/input_error.h"
#include "core/io/sha256.h"
#include "core/io/temporary_files.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::ReadFile;
using testing::TemporaryFolder;

std::string Refusal(const std::function<void()>& write) {
  try {
    write();
  } catch (const InputError& error) {
    return error.what();
  }
  return "written";
}

size_t FilesIn(const fs::path& folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), {}));
}

class OutputPathTest : public ::testing::Test {
 protected:
  OutputPath Opened() const { return OutputPath::Folder(folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(OutputPathTest, APathThatAUserNamedIsWritten) {
  const fs::path file = folder_.Write("file", "theirs");
  WriteFileAtomically(file, "ours");
  EXPECT_EQ(ReadFile(file), "ours");
  EXPECT_FALSE(fs::exists(folder_ / OutputPath::kRecord));
}

TEST_F(OutputPathTest, InAFolderWhatIsSomebodyElsesStays) {
  folder_.Write("file", "theirs");
  folder_.Write("elsewhere", "theirs");
  fs::create_directory(folder_ / "folder");
  fs::create_symlink(folder_ / "elsewhere", folder_ / "link");
  const OutputPath out = Opened();
  for (const char* name : {"file", "folder", "link"}) {
    EXPECT_THAT(Refusal([&] { WriteFileAtomically(out / name, "ours"); }),
                HasSubstr("was not written by this program"))
        << name;
  }
  EXPECT_EQ(ReadFile(folder_ / "file"), "theirs");
  EXPECT_EQ(ReadFile(folder_ / "elsewhere"), "theirs");
  EXPECT_EQ(FilesIn(folder_.path()), 4u);  // No temporary file, no record.
  const std::string all = Refusal([&] { out.RequireFree({"file", "new", "folder", "link"}); });
  for (const char* name : {"file was", "folder was", "link was"}) EXPECT_THAT(all, HasSubstr(name));
  EXPECT_THAT(all, ::testing::Not(HasSubstr("new was")));
}

TEST_F(OutputPathTest, OwnFilesAreReplacedUntilSomebodyChangesThem) {
  WriteFileAtomically(Opened() / "below/file", "first");
  WriteFileAtomically(Opened() / "below/file", "second");
  EXPECT_EQ(ReadFile(folder_ / "below/file"), "second");
  folder_.Write("below/file", "first");  // Also ours: an earlier version that was put back.
  WriteFileAtomically(Opened() / "below/file", "third");
  folder_.Write("below/file", "third, with a note");
  EXPECT_THAT(Refusal([&] { WriteFileAtomically(Opened() / "below/file", "fourth"); }),
              HasSubstr("has been changed since"));
  EXPECT_EQ(ReadFile(folder_ / "below/file"), "third, with a note");
}

TEST_F(OutputPathTest, FilesOfAnotherProcessOfTheProgramAreOwn) {
  const OutputPath out = Opened();
  WriteFileAtomically(Opened() / "file", "by another");
  WriteFileAtomically(out / "file", "by this");
  EXPECT_EQ(ReadFile(folder_ / "file"), "by this");
}

TEST_F(OutputPathTest, WhoIsKilledBetweenRecordAndFileLeavesNothingInTheWay) {
  WriteFileAtomically(Opened() / "file", "old");
  (Opened() / "file").Claim(Sha256("new"));  // And then nothing more.
  EXPECT_EQ(ReadFile(folder_ / "file"), "old");
  WriteFileAtomically(Opened() / "file", "newer");
  EXPECT_EQ(ReadFile(folder_ / "file"), "newer");
}

TEST_F(OutputPathTest, RemovesWhatIsItsOwnAndNothingElse) {
  const OutputPath out = Opened();
  for (const char* name : {"file", "changed", "pictures/a/1", "pictures/b/1", "other/1"}) {
    WriteFileAtomically(out / name, "ours");
  }
  folder_.Write("changed", "theirs");
  folder_.Write("pictures/b/2", "theirs");
  out.RemoveOwn({"file", "changed", "missing", "pictures"});
  EXPECT_FALSE(fs::exists(folder_ / "file"));
  EXPECT_FALSE(fs::exists(folder_ / "pictures/a"));
  EXPECT_FALSE(fs::exists(folder_ / "pictures/b/1"));
  EXPECT_EQ(ReadFile(folder_ / "changed"), "theirs");
  EXPECT_EQ(ReadFile(folder_ / "pictures/b/2"), "theirs");
  EXPECT_EQ(ReadFile(folder_ / "other/1"), "ours");
}

TEST_F(OutputPathTest, AdoptedFilesAreOwn) {
  folder_.Write("file", "of an earlier version");
  folder_.Write("pictures/1", "of an earlier version");
  Opened().Adopt({"file", "missing", "pictures"});
  WriteFileAtomically(Opened() / "file", "ours");
  Opened().RemoveOwn({"pictures"});
  EXPECT_FALSE(fs::exists(folder_ / "pictures"));
}

TEST_F(OutputPathTest, TheRecordIsReadBySha256sum) {
  EXPECT_FALSE(Opened().HasRecord());
  WriteFileAtomically(Opened() / "below/a file", "ours");
  EXPECT_TRUE(Opened().HasRecord());
  const std::string command = "cd '" + folder_.path().string() +
                              "' && sha256sum --check --strict --quiet " + OutputPath::kRecord;
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(ForeseenPathTest, WhatCannotBeWrittenIsForeseenAndNothingIsMade) {
  const TemporaryFolder folder;
  folder.Write("file", "text");
  OutputPath("new.xml").RequireWritable();
  OutputPath(folder / "new.xml").RequireWritable();
  OutputPath(folder / "file").RequireWritable();  // It is replaced.
  OutputPath(folder / "not/yet/there.xml").RequireWritable();
  OutputPath::Folder(folder / "not/yet").RequireWritable();
  EXPECT_THROW(OutputPath(folder.path()).RequireWritable(), InputError);
  EXPECT_THROW(OutputPath(folder / "file/new.xml").RequireWritable(), InputError);
  EXPECT_THROW(OutputPath::Folder(folder / "file").RequireWritable(), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "not"));
}

}  // namespace
}  // namespace fenestra
