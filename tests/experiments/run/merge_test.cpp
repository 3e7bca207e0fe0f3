#include "experiments/run/shards.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "tests/experiments/run/mock_study.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::MockRun;
using testing::MockStudy;
using testing::ReadFile;
using testing::Refusal;
using testing::RowsIn;
using testing::TemporaryFolder;

/// Runs all shards of a study into folders of their own.
std::vector<fs::path> RunShards(const Study& study, int count, const fs::path& folder) {
  std::vector<fs::path> shards;
  for (int index = 1; index <= count; ++index) {
    shards.push_back(folder / fmt::format("shard{}", index));
    RunStudy(MockRun(study, shards.back(), {index, count}));
  }
  return shards;
}

void ExecuteSql(const fs::path& results, const std::string& sql) {
  sqlite3* connection = nullptr;
  ASSERT_EQ(sqlite3_open((results / "results.sqlite").c_str(), &connection), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(connection);
}

TEST(MergeTest, ShardsInAnyOrderGiveTheBitsOfASingleRun) {
  const TemporaryFolder folder;
  const Study study = MockStudy(11);
  RunStudy(MockRun(study, folder / "whole"));
  for (const int count : {1, 2, 5, 40}) {  // 40: more than there are trials.
    const fs::path home = folder / std::to_string(count);
    std::vector<fs::path> shards = RunShards(study, count, home);
    std::reverse(shards.begin(), shards.end());
    MergeShards({.shards = shards, .out = home / "merged"});
    EXPECT_EQ(RowsIn(home / "merged"), RowsIn(folder / "whole"));
    for (const char* file : {"trials.csv", "summary.csv", "study.yaml"}) {
      EXPECT_EQ(ReadFile(home / "merged" / file), ReadFile(folder / "whole" / file)) << file;
    }
    // It is a complete result like any other.
    EXPECT_EQ(RunStudy(MockRun(study, home / "merged")).stored_before, 33);
  }
}

TEST(MergeTest, LostRepeatedAndUnfinishedShardsAreNamed) {
  const TemporaryFolder folder;
  const Study study = MockStudy(4);
  const std::vector<fs::path> shards = RunShards(study, 4, folder.path());
  const auto refusal = [&](const std::vector<fs::path>& given) {
    const std::string text =
        Refusal([&] { MergeShards({.shards = given, .out = folder / "merged"}); });
    EXPECT_FALSE(fs::exists(folder / "merged/results.sqlite"));
    return text;
  };
  EXPECT_THAT(refusal({shards[0], shards[2]}), HasSubstr("missing: shard 2/4, 4/4"));
  EXPECT_THAT(refusal({shards[0], shards[1], shards[1], shards[3]}),
              AllOf(HasSubstr("shard2/results.sqlite: is shard 2/4, as is"),
                    HasSubstr("missing: shard 3/4")));
  EXPECT_THAT(refusal({shards[0], shards[1], shards[2], folder / "shard9"}),
              HasSubstr("shard9: no such file"));
  EXPECT_THAT(refusal({}), HasSubstr("no shards"));
  ExecuteSql(shards[2], "DELETE FROM trials WHERE cell = 1");
  EXPECT_THAT(refusal(shards),
              AllOf(HasSubstr("shard3"), HasSubstr("shard 3/4 lacks 1 of its 3 trials")));
  ExecuteSql(shards[0], "UPDATE trials SET trial = trial + 100 WHERE cell = 2");
  EXPECT_THAT(refusal(shards), HasSubstr("shard 1/4 lacks"));
}

TEST(MergeTest, ShardsOfOtherResultsAreNamed) {
  const TemporaryFolder folder;
  const std::vector<fs::path> shards = RunShards(MockStudy(4), 2, folder.path());
  const auto refusal = [&](const fs::path& other) {
    return Refusal([&] { MergeShards({.shards = {shards[0], other}, .out = folder / "merged"}); });
  };
  RunStudy(MockRun(MockStudy(4, 9), folder / "seed", {2, 2}));
  EXPECT_THAT(refusal(folder / "seed"), HasSubstr("'seed: 3' there, 'seed: 9' here"));
  RunStudy(MockRun(MockStudy(5), folder / "study", {2, 2}));
  EXPECT_THAT(refusal(folder / "study"), HasSubstr("repetitions: 5"));
  RunStudy(MockRun(MockStudy(4), folder / "count", {2, 3}));
  EXPECT_THAT(refusal(folder / "count"), HasSubstr("shards: 2 there, 3 here"));
  for (const auto& [key, name] :
       std::vector<std::pair<std::string, std::string>>{{"version", "version"},
                                                        {"build", "build"},
                                                        {"instruction_set", "instruction set"},
                                                        {"plugins", "plugins"}}) {
    fs::copy(shards[1], folder / key, fs::copy_options::recursive);
    ExecuteSql(folder / key, "UPDATE meta SET value = 'odd' WHERE key = '" + key + "'");
    EXPECT_THAT(refusal(folder / key), AllOf(HasSubstr(name + ": "), HasSubstr("odd here")));
  }
}

TEST(MergeTest, AMergeMayBeRepeatedButReplacesNothingElse) {
  const TemporaryFolder folder;
  const std::vector<fs::path> shards = RunShards(MockStudy(4), 2, folder.path());
  const Merge merge{.shards = shards, .out = folder / "merged"};
  MergeShards(merge);
  const std::string rows = RowsIn(merge.out);
  folder.Write("merged/results.sqlite.merging", "of a merge that was killed");
  MergeShards(merge);
  EXPECT_EQ(RowsIn(merge.out), rows);

  RunStudy(MockRun(MockStudy(7), folder / "other"));
  const std::string before = ReadFile(folder / "other/results.sqlite");
  EXPECT_THAT(Refusal([&] { MergeShards({.shards = shards, .out = folder / "other"}); }),
              HasSubstr("holds another result"));
  EXPECT_THAT(Refusal([&] { MergeShards({.shards = shards, .out = shards[0]}); }),
              HasSubstr("is the folder of a shard"));
  EXPECT_EQ(ReadFile(folder / "other/results.sqlite"), before);
  MergeShards({.shards = shards, .out = folder / "other", .restart = true});
  EXPECT_EQ(RowsIn(folder / "other"), rows);
}

}  // namespace
}  // namespace fenestra
