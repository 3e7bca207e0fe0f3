#include "experiments/run/result_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "core/io/image_io.h"
#include "core/io/input_error.h"
#include "tests/experiments/run/mock_study.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::MockRun;
using testing::MockStudy;
using testing::ReadFile;
using testing::Refusal;
using testing::Row;
using testing::TemporaryFolder;

// All files but the store, which is not written anew.
std::map<std::string, std::string> TextsIn(const fs::path& folder) {
  std::map<std::string, std::string> texts;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (entry.is_regular_file() && !name.starts_with(".") && !name.ends_with(".sqlite")) {
      texts[name] = ReadFile(entry.path());
    }
  }
  return texts;
}

ResultStore Opened(const fs::path& folder) {
  return ResultStore::OpenReadOnly(folder / "results.sqlite");
}

class ResultFiles : public ::testing::Test {
 protected:
  void SetUp() override { RunStudy(MockRun(MockStudy(5), folder_.path())); }

  TemporaryFolder folder_;
};

TEST_F(ResultFiles, FollowFromTheStoreAlone) {
  const std::map<std::string, std::string> before = TextsIn(folder_.path());
  for (const char* name :
       {"study.yaml", "trials.csv", "summary.csv", "summary.md", "intervals.csv"}) {
    EXPECT_TRUE(before.contains(name)) << name;
  }
  const TemporaryFolder other;
  const Study study = MockStudy(5);
  WriteResultFiles(Opened(folder_.path()), study, Cells(study), OutputPath::Folder(other.path()));
  for (const auto& [name, text] : TextsIn(other.path())) {
    ASSERT_TRUE(before.contains(name)) << name;
    EXPECT_EQ(text, before.at(name)) << name;
  }
}

TEST_F(ResultFiles, AreAllThereOrAreNot) {
  EXPECT_TRUE(HasResultFiles(folder_.path()));
  fs::remove(folder_ / "summary.md");
  EXPECT_FALSE(HasResultFiles(folder_.path()));
  const Study study = MockStudy(5);
  WriteResultFiles(Opened(folder_.path()), study, Cells(study), ResultsFolder(folder_.path()));
  EXPECT_TRUE(HasResultFiles(folder_.path()));
}

TEST_F(ResultFiles, AreRemovedWithThePicturesAndNothingElse) {
  folder_.Write("notes.txt", "mine");
  WritePng(ResultsFolder(folder_.path()) / "pictures/cell_000_main_stereo/left.png",
           cv::Mat1b::zeros(2, 2));
  RemoveResultFiles(ResultsFolder(folder_.path()));
  EXPECT_FALSE(HasResultFiles(folder_.path()));
  EXPECT_FALSE(fs::exists(folder_ / "pictures"));
  EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
  EXPECT_TRUE(fs::exists(folder_ / "results.sqlite"));
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    EXPECT_NE(entry.path().extension(), ".csv") << entry.path();
  }
}

TEST_F(ResultFiles, SummariesCountEveryRowOnce) {
  const std::vector<CellSummary> summaries = Summarise(Opened(folder_.path()));
  const Study study = MockStudy(5);
  EXPECT_EQ(summaries.size(), 3 * DetectorsOf(study, CellOf(study, 0)).size());
}

TEST_F(ResultFiles, TheStudyIsReadFromTheStore) {
  const Study study = StudyOf(Opened(folder_.path()), folder_ / "results.sqlite");
  EXPECT_EQ(study, MockStudy(5));
}

TEST(ResultFilesOf, AStoreWithoutAStudyIsRefused) {
  const TemporaryFolder folder;
  const fs::path file = folder / "results.sqlite";
  ResultStore::Create(file, {});
  EXPECT_THAT(Refusal([&] { StudyOf(ResultStore::OpenReadOnly(file), file); }),
              HasSubstr("holds no study"));
}

TEST(ResultFilesOf, ARowOfAnotherStudyIsRefused) {
  const std::vector<Cell> cells = Cells(MockStudy(5));
  EXPECT_NO_THROW(RequireTrialOf(cells, Row(2, 4, Outcome::kHit), "f"));
  EXPECT_THAT(Refusal([&] { RequireTrialOf(cells, Row(3, 0, Outcome::kHit), "f"); }),
              HasSubstr("trial 0 of cell 3"));
  EXPECT_THAT(Refusal([&] { RequireTrialOf(cells, Row(0, 5, Outcome::kHit), "f"); }),
              HasSubstr("trial 5 of cell 0"));
}

TEST(ResultFilesOf, AFolderHoldsItsStoreAndAFileIsOne) {
  const TemporaryFolder folder;
  EXPECT_EQ(StoreFile(folder.path()), folder / "results.sqlite");
  EXPECT_EQ(StoreFile(folder / "other.sqlite"), folder / "other.sqlite");
}

TEST(ResultFilesOf, PicturesOfEachCellHaveAFolder) {
  const Cell cell = CellOf(MockStudy(5), 1);
  EXPECT_EQ(PictureFolder(fs::path("out"), cell).path(),
            fs::path("out/pictures/cell_001_main_stereo"));
}

}  // namespace
}  // namespace fenestra
