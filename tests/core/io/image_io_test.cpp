#include "core/io/image_io.h"

#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using testing::ReadFile;
using testing::TemporaryFolder;

template <typename Image>
bool SamePixels(const Image& a, const Image& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(ImageIoTest, PngKeepsEveryPixelOfEveryKind) {
  const TemporaryFolder folder;
  cv::Mat1b gray(7, 5);
  cv::Mat3b color(7, 5);
  cv::Mat1w depth(7, 5);
  for (int i = 0; i < 35; ++i) {
    gray(i / 5, i % 5) = static_cast<unsigned char>(7 * i);
    color(i / 5, i % 5) = cv::Vec3b(static_cast<unsigned char>(i), 100, 200);
    depth(i / 5, i % 5) = static_cast<uint16_t>(1873 * i);
  }
  WritePng(folder / "gray.png", gray);
  WritePng(folder / "color.png", color);
  WritePng(folder / "depth.png", depth);
  EXPECT_TRUE(SamePixels(ReadGrayImage(folder / "gray.png"), gray));
  EXPECT_TRUE(SamePixels(ReadColorImage(folder / "color.png"), color));
  EXPECT_TRUE(SamePixels(ReadDepthImage(folder / "depth.png"), depth));
}

TEST(ImageIoTest, AnotherKindOfImageIsRefused) {
  const TemporaryFolder folder;
  WritePng(folder / "gray.png", cv::Mat1b::zeros(3, 3));
  WritePng(folder / "color.png", cv::Mat3b::zeros(3, 3));
  EXPECT_THROW(ReadDepthImage(folder / "gray.png"), InputError);
  EXPECT_THROW(ReadGrayImage(folder / "color.png"), InputError);
  EXPECT_NO_THROW(ReadColorImage(folder / "gray.png"));
}

TEST(ImageIoTest, DamagedMissingAndBoastfulFilesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(ReadGrayImage(folder / "missing.png"), InputError);
  EXPECT_THROW(ReadGrayImage(folder.path()), InputError);
  EXPECT_THROW(ReadGrayImage(folder.Write("empty.png", "")), InputError);
  EXPECT_THROW(ReadGrayImage(folder.Write("text.png", "not an image")), InputError);

  WritePng(folder / "good.png", cv::Mat1b::zeros(64, 64));
  std::string bytes = ReadFile(folder / "good.png");
  bytes[18] = '\x7f';  // Width: 32,576 and more.
  try {
    ReadGrayImage(folder.Write("boastful.png", bytes));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("at most 16384"), std::string::npos);
  }
}

TEST(ImageIoTest, TheEndOfTheNumbersIsNoReturn) {
  const TemporaryFolder folder;
  const cv::Mat1w written = (cv::Mat1w(1, 4) << 0, 1, 65534, 65535);
  const cv::Mat1w read = (cv::Mat1w(1, 4) << 0, 1, 65534, 0);
  WritePng(folder / "depth.png", written);
  EXPECT_TRUE(SamePixels(ReadDepthImage(folder / "depth.png"), read));
}

}  // namespace
}  // namespace fenestra
