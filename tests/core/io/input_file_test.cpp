#include "core/io/input_file.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "core/io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using testing::TemporaryFolder;

TEST(InputFileTest, AFileIsReadWholeAndNotBeyondItsLimit) {
  const TemporaryFolder folder;
  const std::string bytes("a\0\xff\n", 4);
  folder.Write("file", bytes);
  EXPECT_EQ(ReadWholeFile(folder / "file", 4), bytes);
  EXPECT_THROW(ReadWholeFile(folder / "file", 3), InputError);
}

TEST(InputFileTest, WhatIsNoRegularFileIsRefusedWithItsReason) {
  const TemporaryFolder folder;
  const auto refusal = [](const std::filesystem::path& file) -> std::string {
    try {
      OpenInput(file);
    } catch (const InputError& error) {
      return error.faults().front().message;
    }
    return "opened";
  };
  EXPECT_EQ(refusal(folder / "none"), "no such file");
  EXPECT_EQ(refusal(folder.path()), "not a regular file");
  EXPECT_EQ(refusal("/dev/zero"), "not a regular file");  // It would never end.
  folder.Write("file", "text");
  EXPECT_EQ(refusal(folder / "file/below"), "no such file");
  EXPECT_EQ(refusal(folder / "file"), "opened");
}

TEST(Utf8Test, EveryLengthOfCharacterIsText) {
  for (const std::string_view text : {"", "plain", "\xc3\xb6", "\xe2\x82\xac", "\xf0\x9f\xaa\x9f",
                                      "\xf4\x8f\xbf\xbf", "\xef\xbb\xbfwith a byte order mark"}) {
    EXPECT_FALSE(FirstNotUtf8(text)) << text;
  }
}

TEST(Utf8Test, TheFirstBadByteIsNamed) {
  // Latin-1, a lone continuation, cut short, overlong, a surrogate, above the last character.
  for (const std::string_view bad : {"\xf6", "\x80", "\xe2\x82", "\xc0\xaf", "\xe0\x80\xaf",
                                     "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff\xfe"}) {
    EXPECT_EQ(FirstNotUtf8(std::string("\xc3\xb6=") + std::string(bad)), 3u);
    EXPECT_EQ(FirstNotUtf8(std::string(bad) + " "), 0u);
  }
}

TEST(FileNameTest, ExtensionsAreComparedInLowerCase) {
  EXPECT_EQ(LowerExtension("a/View.PNG"), ".png");
  EXPECT_EQ(LowerExtension("a.b/scene.Glb"), ".glb");
  EXPECT_EQ(LowerExtension("a.PNG/none"), "");
}

TEST(FileNameTest, HiddenIsTheFileAndNotItsFolder) {
  EXPECT_TRUE(IsHidden("pictures/._left1.png"));
  EXPECT_FALSE(IsHidden(".pictures/left1.png"));
}

}  // namespace
}  // namespace fenestra
