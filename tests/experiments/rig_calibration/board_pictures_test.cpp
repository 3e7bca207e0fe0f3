#include "experiments/rig_calibration/board_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::vector<std::string> Names(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) names.push_back(file.filename().string());
  return names;
}

std::string Complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(BoardPicturesTest, FilesAreTakenInTheOrderOfTheirNumbers) {
  const TemporaryFolder folder;
  for (const char* name : {"left10.png", "left2.png", "left1.png", "right1.png", "notes.txt"}) {
    folder.Write(name, "");
  }
  const std::string in = folder.path().string();
  EXPECT_THAT(Names(ImageFiles({in + "/left*.png"})),
              ElementsAre("left1.png", "left2.png", "left10.png"));
  EXPECT_THAT(Names(ImageFiles({in + "/left?.png"})), ElementsAre("left1.png", "left2.png"));
  EXPECT_THAT(Names(ImageFiles({in})),
              ElementsAre("left1.png", "left2.png", "left10.png", "right1.png"));
  EXPECT_THAT(Names(ImageFiles({in + "/right1.png"})), ElementsAre("right1.png"));
}

TEST(BoardPicturesTest, NumbersAreComparedAsNumbersWhereverTheyStand) {
  const TemporaryFolder folder;
  const std::vector<std::string> sorted = {"a1b2.png",
                                           "a1b10.png",
                                           "a2b1.png",
                                           "a007.png",
                                           "a8.png",
                                           "a09.png",
                                           "a10.png",
                                           "a100.png",
                                           "a99999999999999999999.png",
                                           "a100000000000000000000.png",
                                           "b.png",
                                           "b0.png",
                                           "b00.png",
                                           "b1.png"};
  for (auto name = sorted.rbegin(); name != sorted.rend(); ++name) folder.Write(*name, "");
  EXPECT_EQ(Names(ImageFiles({folder.path().string()})), sorted);
}

TEST(BoardPicturesTest, PatternsMatchWholeNames) {
  const TemporaryFolder folder;
  for (const char* name : {"left1.png", "left1.png.bak", "xleft1.png", "left12.png", "LEFT1.PNG"}) {
    folder.Write(name, "");
  }
  std::filesystem::create_directory(folder / "left3.png");
  const std::string in = folder.path().string();
  EXPECT_THAT(Names(ImageFiles({in + "/left*.png"})), ElementsAre("left1.png", "left12.png"));
  EXPECT_THAT(Names(ImageFiles({in + "/*left?.png"})), ElementsAre("left1.png", "xleft1.png"));
  EXPECT_THAT(Names(ImageFiles({in + "/*t*1*.png"})),
              ElementsAre("left1.png", "left12.png", "xleft1.png"));
  EXPECT_THAT(Names(ImageFiles({in})),
              ElementsAre("LEFT1.PNG", "left1.png", "left12.png", "xleft1.png"));
  // A file whose name has a star in it is that file.
  folder.Write("left*.png", "");
  EXPECT_THAT(Names(ImageFiles({in + "/left*.png"})), ElementsAre("left*.png"));
}

TEST(BoardPicturesTest, FirstGoesWithFirst) {
  const auto pairs = PairUp({"l/a.png", "l/b.png"}, {"r/c.png", "r/d.png"});
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[1].left, "l/b.png");
  EXPECT_EQ(pairs[1].right, "r/d.png");
  EXPECT_TRUE(PairUp({}, {}).empty());
}

TEST(BoardPicturesTest, APairOfTwoMomentsIsRefused) {
  // 2 is missing on the left, 3 on the right.
  EXPECT_THAT(Complaint([] {
                PairUp({"left1.png", "left3.png", "left4.png"},
                       {"right01.png", "right02.png", "right04.png"});
              }),
              "none");  // Nothing on the right is called 3: the clocks may differ.
  EXPECT_THAT(Complaint([] {
                PairUp({"left1.png", "left3.png", "left4.png"},
                       {"right01.png", "right02.png", "right03.png"});
              }),
              HasSubstr("left3.png would be paired with right02.png, not with right03.png"));
  EXPECT_THAT(Complaint([] {
                PairUp({"left010.png", "left0.png"}, {"right0.png", "right10.png"});
              }),
              HasSubstr("left010.png"));
  // Numbers of the cameras, times that differ a little, names without numbers: no reason.
  for (const auto& [left, right] : std::vector<
           std::pair<std::vector<std::filesystem::path>, std::vector<std::filesystem::path>>>{
           {{"cam0_1.png", "cam0_2.png"}, {"cam1_1.png", "cam1_2.png"}},
           {{"10-59-59.png", "11-00-01.png"}, {"10-59-58.png", "11-00-59.png"}},
           {{"a.png", "b.png"}, {"b.png", "a.png"}},
           {{"1_v2.png", "3_v2.png"}, {"1_v2r.png", "3_v2r.png"}}}) {
    EXPECT_EQ(Complaint([&] { PairUp(left, right); }), "none") << left[0];
  }
}

TEST(BoardPicturesTest, OneFileIsNotBothPictures) {
  const TemporaryFolder folder;
  const auto file = folder.Write("view1.png", "");
  std::filesystem::create_symlink(file, folder / "right1.png");
  EXPECT_THAT(Complaint([&] { PairUp({file}, {file}); }), HasSubstr("both"));
  EXPECT_THAT(Complaint([&] { PairUp({file}, {folder / "right1.png"}); }), HasSubstr("both"));
}

TEST(BoardPicturesTest, WhatIsNotThereIsNamed) {
  const TemporaryFolder folder;
  const std::string in = folder.path().string();
  EXPECT_THAT(Complaint([&] { ImageFiles({in + "/left1.png"}); }), HasSubstr("left1.png"));
  EXPECT_THAT(Complaint([&] { ImageFiles({in + "/left*.png"}); }), HasSubstr("left*.png"));
  EXPECT_THAT(Complaint([&] {
                PairUp({"a.png", "b.png"}, {"c.png"});
              }),
              ::testing::AllOf(HasSubstr("2"), HasSubstr("1")));
}

TEST(BoardPicturesTest, PicturesOfTwoSizesAreRefusedByName) {
  const std::string data = FENESTRA_SOURCE_DIR "/tests/data/";
  EXPECT_THAT(Complaint([&] {
                CalibrateFromPictures({{data + "stereo-calibration/left01.jpg",
                                        data + "stereo-calibration/right01.jpg"},
                                       {data + "README.md", data + "nothing.png"}},
                                      {.square_m = 0.03}, {});
              }),
              ::testing::AllOf(HasSubstr("README.md"), HasSubstr("nothing.png")));
}

TEST(BoardPicturesTest, HiddenFilesAreTakenOnlyWhereTheyAreMeant) {
  const TemporaryFolder folder;
  for (const char* name : {"left1.png", "._left1.png", ".hidden.png", ".DS_Store"}) {
    folder.Write(name, "");
  }
  const std::string in = folder.path().string();
  EXPECT_THAT(Names(ImageFiles({in})), ElementsAre("left1.png"));
  EXPECT_THAT(Names(ImageFiles({in + "/*.png"})), ElementsAre("left1.png"));
  EXPECT_THAT(Names(ImageFiles({in + "/.h*.png"})), ElementsAre(".hidden.png"));
  EXPECT_THAT(Names(ImageFiles({in + "/.hidden.png"})), ElementsAre(".hidden.png"));
  // In a folder whose own name begins with a dot, the others.
  std::filesystem::create_directory(folder / ".views");
  folder.Write(".views/left1.PNG", "");
  folder.Write(".views/._left1.PNG", "");
  EXPECT_THAT(Names(ImageFiles({in + "/.views"})), ElementsAre("left1.PNG"));
}

TEST(BoardPicturesTest, EndingsInCapitalLettersAreThoseOfImages) {
  const TemporaryFolder folder;
  for (const char* name : {"1.JPG", "2.Jpeg", "3.PNG", "4.TIF", "5.PGM", "6.TXT"}) {
    folder.Write(name, "");
  }
  EXPECT_THAT(Names(ImageFiles({folder.path().string()})),
              ElementsAre("1.JPG", "2.Jpeg", "3.PNG", "4.TIF", "5.PGM"));
}

// A pair that stands one above the other: the same pictures, turned by 90 degrees.
TEST(BoardPicturesTest, ARigThatNoDetectorTakesIsRefused) {
  const TemporaryFolder folder;
  const std::string data = FENESTRA_SOURCE_DIR "/tests/data/stereo-calibration/";
  std::vector<PicturePair> pairs;
  for (const char* number : {"01", "03", "05", "07", "09", "12"}) {
    const auto turned = [&](const std::string& side) {
      cv::Mat picture = cv::imread(data + side + number + ".jpg", cv::IMREAD_GRAYSCALE);
      cv::rotate(picture, picture, cv::ROTATE_90_CLOCKWISE);
      const auto file = folder / (side + number + ".png");
      cv::imwrite(file.string(), picture);
      return file;
    };
    pairs.push_back({turned("left"), turned("right")});
  }
  const CalibrationBoard board{
      .kind = BoardKind::kChessboard, .columns = 10, .rows = 7, .square_m = 0.03, .marker_m = 0.0};
  EXPECT_THAT(Complaint([&] { CalibrateFromPictures(pairs, board, {}); }),
              HasSubstr("must stand to the right of the left one"));
}

}  // namespace
}  // namespace fenestra
