#include "experiments/validation/validation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/temporary_folder.h"

namespace fenestra::validation {
namespace {

bool AllHold(const std::vector<Row>& rows) {
  return std::all_of(rows.begin(), rows.end(),
                     [](const Row& row) { return row.verdict == Verdict::kHolds; });
}

Verdict VerdictOf(const std::vector<Row>& rows, const std::string& words) {
  for (const Row& row : rows) {
    if (row.phenomenon.find(words) != std::string::npos) return row.verdict;
  }
  ADD_FAILURE() << "no row " << words;
  return Verdict::kNotJudged;
}

// The twins: a sensor without a shoulder, whose variance grows on, and one that reads quietly.
TEST(CameraRowsTest, GreyValuesVaryAsRecordedUnlessTheSensorIsAnother) {
  const std::vector<Row> rows = PhotonTransferRows({});
  EXPECT_EQ(rows.size(), 4u);
  for (const Row& row : rows) {
    EXPECT_EQ(row.verdict, Verdict::kHolds) << row.phenomenon << ": " << row.simulated;
  }
  ImageSensorOptions linear;
  linear.linear_range = 1.0;
  EXPECT_EQ(VerdictOf(PhotonTransferRows(linear), "over that at 170"), Verdict::kMisfit);
  ImageSensorOptions quiet;
  quiet.read_noise_e = 5.0;
  EXPECT_EQ(VerdictOf(PhotonTransferRows(quiet), "at grey 12"), Verdict::kMisfit);
}

TEST(CameraRowsTest, AnEvaluationFindsWhatWasPutIn) {
  const std::vector<Row> rows = EmvaRows({});
  EXPECT_GE(rows.size(), 5u);
  EXPECT_TRUE(AllHold(rows));
}

TEST(CameraRowsTest, CalibrationsOfRecordedAndSimulatedBoardsStandBesideEachOther) {
  const std::vector<Row> rows = CalibrationRows(FENESTRA_SOURCE_DIR "/tests/data");
  ASSERT_EQ(rows.size(), 3u);
  for (const Row& row : rows) EXPECT_NE(row.verdict, Verdict::kNotJudged) << row.phenomenon;
}

TEST(CameraRowsTest, TheLastWordOnCyclesIsTakenFromItsOwnSection) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(CyclesRow(folder / "none.md").verdict, Verdict::kNotJudged);
  const auto verdict = [&folder](const std::string& text) {
    return CyclesRow(folder.Write("results.md", text)).verdict;
  };
  EXPECT_EQ(verdict("## cycles\n\nBlender 3.4: agrees.\n\n## emva1288\n\nx: DISAGREES.\n"),
            Verdict::kHolds);
  EXPECT_EQ(verdict("## cycles\n\nBlender 3.4: DISAGREES.\n"), Verdict::kMisfit);
  EXPECT_EQ(verdict("## emva1288\n\nx: agrees.\n"), Verdict::kNotJudged);
}

}  // namespace
}  // namespace fenestra::validation
