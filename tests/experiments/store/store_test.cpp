#include "experiments/store/store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#include "core/io/input_error.h"
#include "experiments/analysis/cell_tally.h"
#include "experiments/run/result_files.h"
#include "experiments/store/record_json.h"
#include "tests/experiments/trial/record_examples.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
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

std::vector<uint64_t> Bits(const auto& matrix) {
  std::vector<uint64_t> bits;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    bits.push_back(std::bit_cast<uint64_t>(matrix.data()[i]));
  }
  return bits;
}

void ExpectSameBits(const FactorValues& a, const FactorValues& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].first, b[i].first);
    ASSERT_EQ(a[i].second.index(), b[i].second.index());
    if (const double* number = std::get_if<double>(&a[i].second)) {
      EXPECT_EQ(std::bit_cast<uint64_t>(*number),
                std::bit_cast<uint64_t>(std::get<double>(b[i].second)));
    } else {
      EXPECT_EQ(a[i].second, b[i].second);
    }
  }
}

void ExpectSameBits(const Score& a, const Score& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.detail, b.detail);
  ASSERT_EQ(a.truth_p_CO.has_value(), b.truth_p_CO.has_value());
  if (a.truth_p_CO) {
    EXPECT_EQ(Bits(*a.truth_p_CO), Bits(*b.truth_p_CO));
  }
  ASSERT_EQ(a.estimate.has_value(), b.estimate.has_value());
  if (!a.estimate) return;
  EXPECT_EQ(Bits(a.estimate->p_CO), Bits(b.estimate->p_CO));
  EXPECT_EQ(Bits(a.estimate->normal_C), Bits(b.estimate->normal_C));
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(Bits(a.estimate->p_CV[i]), Bits(b.estimate->p_CV[i]));
  ASSERT_EQ(a.estimate->covariance_C.has_value(), b.estimate->covariance_C.has_value());
  if (a.estimate->covariance_C) {
    EXPECT_EQ(Bits(*a.estimate->covariance_C), Bits(*b.estimate->covariance_C));
  }
}

void ExpectSameBits(const TrialRecord& a, const TrialRecord& b) {
  EXPECT_EQ(std::tie(a.cell, a.trial, a.part, a.sensor, a.detector),
            std::tie(b.cell, b.trial, b.part, b.sensor, b.detector));
  ExpectSameBits(a.levels, b.levels);
  ExpectSameBits(a.drawn, b.drawn);
  ExpectSameBits(a.score, b.score);
  ASSERT_EQ(a.bound_C.has_value(), b.bound_C.has_value());
  if (a.bound_C) {
    EXPECT_EQ(Bits(*a.bound_C), Bits(*b.bound_C));
  }
  ASSERT_EQ(a.stages.size(), b.stages.size());
  for (size_t i = 0; i < a.stages.size(); ++i) {
    EXPECT_EQ(a.stages[i].stage, b.stages[i].stage);
    EXPECT_EQ(std::bit_cast<uint64_t>(a.stages[i].seconds),
              std::bit_cast<uint64_t>(b.stages[i].seconds));
  }
}

/// Values that texts and number formats are apt to change.
TrialRecord DifficultRow(int trial) {
  TrialRecord row = RandomHit(3, trial, "label with spaces, commas");
  row.part = "näher — 近";
  row.sensor = SensorKind::kRgbd;
  row.levels = {{"zulu", 0.1},
                {"alpha", std::numeric_limits<double>::denorm_min()},
                {"negative_zero", -0.0},
                {"whole", 3.0},
                {"large", 1e300},
                {"unlimited", -std::numeric_limits<double>::infinity()},
                {"word", std::string("3.0")},
                {"quoted \"name\"", std::string("a\"b\\c\nd")},
                {"flag", false}};
  row.score.detail = "a \"quoted\", two-line\r\ntext, a NUL" + std::string(1, '\0') + "and 'it'";
  row.score.estimate->p_CO = {-0.0, 1.0 / 3.0, std::nextafter(2.0, 3.0)};
  row.score.estimate->covariance_C->setConstant(-0.0);
  row.score.truth_p_CO = Eigen::Vector3d(5e-324, -0.0, 2.0);
  row.bound_C = 1e-300 / 3.0 * Eigen::Matrix3d::Identity();
  row.stages = {{"zeta", 1e-9}, {"Kante finden", 0.0}, {"alpha", 1.0 / 3.0}};
  return row;
}

TEST_F(Store, RowsComeBackToTheLastBit) {
  std::vector<TrialRecord> rows = {DifficultRow(0), Row(3, 1, Outcome::kMissed),
                                   Row(3, 2, Outcome::kClear), RandomHit(4, 0)};
  rows[3].score.estimate->covariance_C.reset();
  {
    ResultStore store = ResultStore::Create(file_, {{"seed", "2013"}, {"study", "a: 'b'\n"}});
    for (const TrialRecord& row : rows) store.AddTrial({&row, 1});
  }
  const ResultStore store = ResultStore::OpenReadOnly(file_);
  const std::vector<TrialRecord> read = store.Rows();
  ASSERT_EQ(read.size(), rows.size());
  for (size_t i = 0; i < rows.size(); ++i) ExpectSameBits(read[i], rows[i]);
  EXPECT_EQ(store.Metadata().at("study"), "a: 'b'\n");
  EXPECT_EQ(store.Metadata().at("schema_version"), "3");
}

TEST_F(Store, RowsAreOrderedByCellTrialAndDetector) {
  ResultStore store = ResultStore::Create(file_, {});
  for (const int trial : {10, 9, 2}) {
    for (const int cell : {1, 0}) {
      const std::vector<TrialRecord> rows = {Row(cell, trial, Outcome::kMissed, "b"),
                                             Row(cell, trial, Outcome::kMissed, "B"),
                                             Row(cell, trial, Outcome::kMissed, "a")};
      store.AddTrial(rows);
    }
  }
  const std::vector<TrialRecord> rows = store.Rows();
  ASSERT_EQ(rows.size(), 18u);
  for (size_t i = 1; i < rows.size(); ++i) {
    EXPECT_LT(std::tie(rows[i - 1].cell, rows[i - 1].trial, rows[i - 1].detector),
              std::tie(rows[i].cell, rows[i].trial, rows[i].detector));
  }
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

TEST_F(Store, RowsThatCannotBeAreRefused) {
  const auto complaint = [&](const std::string& change) -> std::string {
    {
      ResultStore store = ResultStore::Create(file_, {});
      for (int trial = 0; trial < 3; ++trial) {
        const TrialRecord row = RandomHit(0, trial);
        store.AddTrial({&row, 1});
      }
    }
    sqlite3* connection = nullptr;
    EXPECT_EQ(sqlite3_open(file_.c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, ("UPDATE trials SET " + change).c_str(), nullptr, nullptr,
                           nullptr),
              SQLITE_OK)
        << change;
    sqlite3_close(connection);
    std::string text;
    try {
      Summarise(ResultStore::OpenReadOnly(file_));
    } catch (const InputError& error) {
      text = error.what();
    }
    fs::remove(file_);
    return text;
  };
  EXPECT_EQ(complaint("detail = 'other'"), "");
  EXPECT_THAT(complaint("trial = -7 WHERE trial = 1"), ::testing::HasSubstr("cell or trial -7"));
  EXPECT_THAT(complaint("cell = 1 << 40 WHERE trial = 1"), ::testing::HasSubstr("cell or trial"));
  EXPECT_THAT(complaint("estimate_x_m = 1e999"), ::testing::HasSubstr("not finite"));
  EXPECT_THAT(complaint("truth_x_m = NULL, outcome = 'hit'"),
              ::testing::HasSubstr("a hit without its error"));
  EXPECT_THAT(complaint("outcome = 'great'"), ::testing::HasSubstr("unknown outcome"));
  EXPECT_THAT(complaint("part = 'other' WHERE trial = 1"), ::testing::HasSubstr("not of one cell"));
  EXPECT_THAT(complaint("levels = '{}' WHERE trial = 1"), ::testing::HasSubstr("not of one cell"));
}

TEST_F(Store, ARunThatCannotStartLeavesNothing) {
  WriteBytes(folder_ / "file", "in the way");
  EXPECT_THROW(ResultStore::Create(folder_ / "file" / "results.sqlite", {}), InputError);
  fs::create_directory(file_);
  EXPECT_THROW(ResultStore::Create(file_, {}), InputError);
  EXPECT_THROW(ResultStore::Create(file_, {}, ResultStore::IfExists::kReplace), InputError);
  EXPECT_THAT(FilesInFolder(), ::testing::UnorderedElementsAre("file", "results.sqlite"));
}

TEST(RecordJson, ForeignTextIsAnError) {
  for (const char* text : {"", "{", "[1]", "3", "{\"a\": null}", "{\"a\": [1]}"}) {
    EXPECT_THROW(FactorsFromJson(text), std::runtime_error) << text;
    EXPECT_THROW(StageTimesFromJson(text), std::runtime_error) << text;
    EXPECT_THROW(CornersFromJson(text), std::runtime_error) << text;
    EXPECT_THROW(MatrixFromJson(text), std::runtime_error) << text;
  }
}

}  // namespace
}  // namespace fenestra
