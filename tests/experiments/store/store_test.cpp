#include "experiments/store/store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "core/io/input_error.h"
#include "tests/experiments/store/same_bits.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using testing::ExpectSameBits;
using testing::RandomHit;
using testing::Row;

/// An empty folder of its own for every test.
class Store : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "fenestra-store-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    file_ = folder_ / "results.sqlite";
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> FilesInFolder() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  fs::path folder_;
  fs::path file_;
};

std::string ReadBytes(const fs::path& file) {
  std::stringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

void WriteBytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(Store, SeveralThreadsLoseNothing) {
  constexpr int kThreads = 4;
  constexpr int kTrials = 50;
  ResultStore store = ResultStore::Create(file_, {});
  {
    std::vector<std::jthread> threads;
    for (int cell = 0; cell < kThreads; ++cell) {
      threads.emplace_back([&store, cell] {
        for (int trial = 0; trial < kTrials; ++trial) {
          const std::vector<TrialRecord> rows = {RandomHit(cell, trial, "a"),
                                                 RandomHit(cell, trial, "b")};
          store.AddTrial(rows);
        }
      });
    }
  }
  const std::vector<TrialRecord> rows = ResultStore::OpenReadOnly(file_).Rows();
  ASSERT_EQ(rows.size(), size_t{2 * kThreads * kTrials});
  for (const TrialRecord& row : rows) {
    ExpectSameBits(row, RandomHit(row.cell, row.trial, row.detector));
  }
  EXPECT_EQ(store.FinishedTrials().size(), size_t{kThreads * kTrials});
}

TEST_F(Store, ATrialIsStoredAsAWholeOrNotAtAll) {
  ResultStore store = ResultStore::Create(file_, {});
  const std::vector<TrialRecord> first = {RandomHit(0, 0, "b")};
  store.AddTrial(first);
  const std::vector<TrialRecord> clash = {RandomHit(0, 0, "a"), RandomHit(0, 0, "b")};
  EXPECT_THROW(store.AddTrial(clash), InputError);
  EXPECT_EQ(store.Rows().size(), 1u);
  std::vector<TrialRecord> broken = {RandomHit(0, 1, "a"), RandomHit(0, 1, "b")};
  broken[1].score.truth_p_CO->y() = std::nan("");
  EXPECT_THROW(store.AddTrial(broken), std::logic_error);
  const std::vector<TrialRecord> two_trials = {RandomHit(0, 2), RandomHit(0, 3)};
  EXPECT_THROW(store.AddTrial(two_trials), std::logic_error);
  EXPECT_EQ(store.Rows().size(), 1u);
  // And the store goes on.
  const std::vector<TrialRecord> next = {RandomHit(0, 1, "a"), RandomHit(0, 1, "b")};
  store.AddTrial(next);
  ASSERT_EQ(store.Rows().size(), 3u);
  ExpectSameBits(store.Rows()[2], next[1]);
}

TEST_F(Store, OneTrialIsFoundAloneAndDetectorsAreCounted) {
  ResultStore store = ResultStore::Create(file_, {});
  const std::vector<std::vector<TrialRecord>> trials = {
      {RandomHit(0, 0, "a"), Row(0, 0, Outcome::kMissed, "b")},
      {RandomHit(1, 0, "a"), Row(1, 0, Outcome::kOutOfView, "b")},
      {RandomHit(1, 1, "a"), Row(1, 1, Outcome::kClear, "b")}};
  store.AddTrials(trials);
  ASSERT_EQ(store.RowsOf({1, 1}).size(), 2u);
  ExpectSameBits(store.RowsOf({1, 1})[0], trials[2][0]);
  EXPECT_TRUE(store.RowsOf({0, 1}).empty());
  const std::vector<DetectorTally> tallies = store.Tallies();
  ASSERT_EQ(tallies.size(), 2u);
  EXPECT_EQ(tallies[0].hits, 3);
  EXPECT_EQ(tallies[0].in_view, 3);
  EXPECT_EQ(tallies[1].hits, 0);
  EXPECT_EQ(tallies[1].in_view, 1);
}

TEST_F(Store, RunsAreRemembered) {
  ResultStore store = ResultStore::Create(file_, {});
  const int64_t killed = store.AddRun({.started_utc = "a", .host = "n1", .command = "run 'x y'"});
  const int64_t ended = store.AddRun({.shard = "2/8", .started_utc = "b", .jobs = 3});
  store.SetRunEnd(ended, "c");
  EXPECT_NE(killed, ended);
  const std::vector<RunEntry> runs = store.Runs();
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].ended_utc, std::nullopt);
  EXPECT_EQ(runs[0].command, "run 'x y'");
  EXPECT_EQ(runs[1].ended_utc, "c");
  EXPECT_EQ(runs[1].shard, "2/8");
  EXPECT_EQ(runs[1].jobs, 3);
}

TEST_F(Store, AKilledRunKeepsItsTrialsAndGoesOn) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ResultStore store = ResultStore::Create(file_, {{"seed", "1"}});
    for (int trial = 0; trial < 5; ++trial) {
      const TrialRecord row = RandomHit(0, trial);
      store.AddTrial({&row, 1});
    }
    _exit(0);  // No destructor runs.
  }
  waitpid(child, nullptr, 0);
  ResultStore store = ResultStore::Resume(file_);
  EXPECT_EQ(store.FinishedTrials().size(), 5u);
  const TrialRecord row = RandomHit(0, 5);
  store.AddTrial({&row, 1});
  EXPECT_EQ(ResultStore::OpenReadOnly(file_).Rows().size(), 6u);
  EXPECT_EQ(store.Metadata().at("seed"), "1");
}

TEST_F(Store, ATrialThatWasHalfWrittenIsRolledBack) {
  const fs::path live = folder_ / "live.sqlite";
  ResultStore store = ResultStore::Create(live, {});
  const TrialRecord row = RandomHit(0, 0);
  store.AddTrial({&row, 1});
  // The state on disk in the middle of a transaction: pages changed, the journal hot.
  sqlite3* connection = nullptr;
  ASSERT_EQ(sqlite3_open(live.c_str(), &connection), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(connection, "BEGIN; UPDATE trials SET outcome = 'gross'", nullptr, nullptr,
                         nullptr),
            SQLITE_OK);
  ASSERT_EQ(sqlite3_db_cacheflush(connection), SQLITE_OK);
  fs::copy_file(live, file_);
  fs::copy_file(live.string() + "-journal", file_.string() + "-journal");
  sqlite3_close(connection);

  const std::vector<TrialRecord> rows = ResultStore::OpenReadOnly(file_).Rows();
  ASSERT_EQ(rows.size(), 1u);
  ExpectSameBits(rows[0], row);
}

TEST_F(Store, OldResultsStandUntilTheyAreReplacedOnPurpose) {
  const TrialRecord row = RandomHit(0, 0);
  ResultStore::Create(file_, {{"run", "old"}}).AddTrial({&row, 1});
  const std::string before = ReadBytes(file_);
  EXPECT_THROW(ResultStore::Create(file_, {}), InputError);
  EXPECT_EQ(ReadBytes(file_), before);
  const ResultStore fresh =
      ResultStore::Create(file_, {{"run", "new"}}, ResultStore::IfExists::kReplace);
  EXPECT_EQ(fresh.Metadata().at("run"), "new");
  EXPECT_TRUE(fresh.Rows().empty());
  EXPECT_THAT(FilesInFolder(), ::testing::ElementsAre("results.sqlite"));
}

TEST_F(Store, AReaderCannotWrite) {
  ResultStore::Create(file_, {});
  const std::string before = ReadBytes(file_);
  ResultStore store = ResultStore::OpenReadOnly(file_);
  const TrialRecord row = RandomHit(0, 0);
  EXPECT_THROW(store.AddTrial({&row, 1}), std::logic_error);
  EXPECT_THROW(store.AddRun({}), std::logic_error);
  EXPECT_EQ(ReadBytes(file_), before);
}

/// Every way to open a file refuses it with this text and leaves it as it is.
void ExpectRefused(const fs::path& file, const std::string& text) {
  const std::string before = ReadBytes(file);
  const auto refusal = [&](const auto& open) -> std::string {
    try {
      open();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal([&] { ResultStore::OpenReadOnly(file).Rows(); }), ::testing::HasSubstr(text));
  EXPECT_THAT(refusal([&] { ResultStore::Resume(file).Rows(); }), ::testing::HasSubstr(text));
  EXPECT_THAT(refusal([&] { ResultStore::Create(file, {}, ResultStore::IfExists::kReplace); }),
              ::testing::HasSubstr(text));
  EXPECT_EQ(ReadBytes(file), before);
  EXPECT_FALSE(fs::exists(file.string() + "-journal"));
}

TEST_F(Store, FilesOfOthersAreRefusedAndUntouched) {
  WriteBytes(file_, "");
  ExpectRefused(file_, "not an SQLite file");
  WriteBytes(file_, "part,sensor,cell\n" + std::string(4096, 'x'));
  ExpectRefused(file_, "not an SQLite file");

  fs::remove(file_);
  sqlite3* connection = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &connection), SQLITE_OK);
  sqlite3_exec(connection, "CREATE TABLE bookmarks (url TEXT)", nullptr, nullptr, nullptr);
  sqlite3_close(connection);
  ExpectRefused(file_, "another program");
  EXPECT_THROW(ResultStore::OpenReadOnly(folder_ / "none.sqlite"), InputError);
  EXPECT_THROW(ResultStore::OpenReadOnly(folder_), InputError);
}

TEST_F(Store, DamagedStoresAreRefusedAndUntouched) {
  {
    ResultStore store = ResultStore::Create(file_, {});
    for (int trial = 0; trial < 40; ++trial) {
      const TrialRecord row = RandomHit(0, trial);
      store.AddTrial({&row, 1});
    }
  }
  const std::string sound = ReadBytes(file_);
  ASSERT_GT(sound.size(), 40'000u);
  WriteBytes(file_, sound.substr(0, sound.size() / 2));
  ExpectRefused(file_, "results.sqlite");
  // Each page but the first in turn filled with rubbish.
  for (size_t page = 4096; page < sound.size(); page += 4096) {
    std::string damaged = sound;
    damaged.replace(page, 4096, std::string(4096, '\xAA'));
    WriteBytes(file_, damaged);
    ExpectRefused(file_, "results.sqlite");
  }
  std::string newer = sound;
  newer[63] = 99;
  WriteBytes(file_, newer);
  ExpectRefused(file_, "schema version 99");
}

TEST_F(Store, ARunThatCannotStartLeavesNothing) {
  WriteBytes(folder_ / "file", "in the way");
  EXPECT_THROW(ResultStore::Create(folder_ / "file" / "results.sqlite", {}), InputError);
  fs::create_directory(file_);
  EXPECT_THROW(ResultStore::Create(file_, {}), InputError);
  EXPECT_THROW(ResultStore::Create(file_, {}, ResultStore::IfExists::kReplace), InputError);
  EXPECT_THAT(FilesInFolder(), ::testing::UnorderedElementsAre("file", "results.sqlite"));
}

}  // namespace
}  // namespace fenestra
