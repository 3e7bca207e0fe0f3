#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "core/io/input_error.h"
#include "experiments/run/result_files.h"
#include "experiments/store/store.h"
#include "tests/experiments/store/same_bits.h"
#include "tests/experiments/trial/record_examples.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using testing::ExpectSameBits;
using testing::RandomHit;
using testing::Row;

class StoreRows : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "results.sqlite";
};

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

TEST_F(StoreRows, RowsComeBackToTheLastBit) {
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

TEST_F(StoreRows, RowsAreOrderedByCellTrialAndDetector) {
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

TEST_F(StoreRows, RowsThatCannotBeAreRefused) {
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

}  // namespace
}  // namespace fenestra
