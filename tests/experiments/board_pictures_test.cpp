#include "experiments/board_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/input_error.h"
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

}  // namespace
}  // namespace fenestra
