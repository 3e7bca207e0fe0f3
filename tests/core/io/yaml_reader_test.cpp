#include "core/io/yaml_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::string FaultsOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(YamlReaderTest, EveryFaultHasItsPlaceAndAllAreReported) {
  YamlReader reader = YamlReader::FromText("a: x\nb:\n  - 1\n  - oops\nc: 3\n", "file.yaml");
  reader.Number(reader.root()["a"], "a");
  reader.Numbers(reader.root()["b"], "b");
  EXPECT_EQ(reader.Number(reader.root()["c"], "c"), 3.0);
  const std::string faults = FaultsOf([&] { reader.ThrowIfFaulty(); });
  EXPECT_THAT(faults, HasSubstr("file.yaml:1:4: a must be a finite number, not 'x'\n"));
  EXPECT_THAT(faults, HasSubstr("file.yaml:4:5: each entry of b must be a finite number"));
}

TEST(YamlReaderTest, WhatWasReadIsSoundUntilThereIsAFurtherFault) {
  YamlReader reader = YamlReader::FromText("a: x\nb: 2\n", "f");
  reader.Number(reader.root()["a"], "a");
  const size_t before = reader.fault_count();
  reader.Number(reader.root()["b"], "b");
  EXPECT_EQ(reader.IfSoundSince(before, 7), 7);
  reader.Boolean(reader.root()["b"], "b");
  EXPECT_EQ(reader.IfSoundSince(before, 7), std::nullopt);
}

TEST(YamlReaderTest, UnknownAndRepeatedKeysAreFaults) {
  YamlReader reader = YamlReader::FromText("sensrs: 1\nseed: 2\nseed: 3\n", "f");
  const std::vector<std::string> allowed = {"sensors", "seed"};
  EXPECT_FALSE(reader.CheckKeys(reader.root(), "the study", allowed));
  const std::string faults = FaultsOf([&] { reader.ThrowIfFaulty(); });
  EXPECT_THAT(faults,
              HasSubstr("f:1:1: unknown key 'sensrs' in the study. Did you mean 'sensors'?"));
  EXPECT_THAT(faults, HasSubstr("f:3:1: 'seed' stands twice in the study"));
}

TEST(YamlReaderTest, NumbersAreNeitherQuotedNorInfinite) {
  YamlReader reader =
      YamlReader::FromText("[\"1\", .inf, 1e999, 0x10, 1.5m, +-5, ++5, +, +2]", "f");
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_FALSE(reader.Number(reader.root()[i], "x")) << i;
  }
  EXPECT_EQ(reader.Number(reader.root()[8], "x"), 2.0);
}

TEST(YamlReaderTest, UnreadableFilesSayWhy) {
  const TemporaryFolder folder;
  const auto read = [&](const std::filesystem::path& file) {
    return FaultsOf([&] { YamlReader::FromFile(file); });
  };
  EXPECT_THAT(read(folder / "missing"), HasSubstr("no such file"));
  EXPECT_THAT(read(folder.path()), HasSubstr("not a regular file"));
  EXPECT_THAT(read(folder.Write("empty", " \n")), HasSubstr("empty"));
  EXPECT_THAT(read(folder.Write("nul", std::string("a: 1\nb\0", 7))),
              HasSubstr("nul:2:2: not a text"));
  EXPECT_THAT(read(folder.Write("huge", std::string(5 << 20, '\0'))), HasSubstr("at most"));
  EXPECT_THAT(read(folder.Write("bad", "a: [1, 2\nb: 3\n")), HasSubstr("bad:2:"));
  EXPECT_THAT(read(folder.Write("deep", std::string(100000, '['))), HasSubstr("not valid YAML"));
}

TEST(YamlReaderTest, OneDocumentIsReadAndAnotherIsRefused) {
  const auto read = [](const std::string& text) {
    return FaultsOf([&] { YamlReader::FromText(text, "f"); });
  };
  for (const char* text : {"a: 1\n", "---\na: 1\n", "%YAML:1.0\n---\na: 1\n", "a: 1\n...\n",
                           "# first\n---\na: |\n  --- no line of its own\n", "{\"a\": 1}"}) {
    EXPECT_EQ(read(text), "no fault") << text;
  }
  EXPECT_THAT(read("a: 1\n---\nb: 2\n"), HasSubstr("f:3:1: more than one document"));
  EXPECT_THAT(read("%YAML:1.0\n---\na: 1\n%YAML:1.0\n---\na: 2\n"),
              HasSubstr("more than one document"));
  EXPECT_THAT(read("a: 1\n...\nb: 2\n"), HasSubstr("more than one document"));
  EXPECT_THAT(read("a: 1\n...\nnot YAML at all: [\n"), HasSubstr("not valid YAML"));
}

TEST(YamlReaderTest, OtherEncodingsAreRefusedWithTheirPlace) {
  const auto read = [](const std::string& text) {
    return FaultsOf([&] { YamlReader::FromText(text, "f"); });
  };
  EXPECT_EQ(read("a: \"ge\xc3\xb6"
                 "ffnet\"\n"),
            "no fault");
  EXPECT_THAT(read("a: 1\nb: ge\xf6"
                   "ffnet\n"),
              HasSubstr("f:2:6: not UTF-8 text"));
  EXPECT_THAT(read("\xff\xfe"
                   "a"),
              HasSubstr("f:1:1: not UTF-8 text"));
}

}  // namespace
}  // namespace fenestra
