#include "renderers/exr_io.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/io/input_error.h"
#include "core/random/random_stream.h"

namespace fenestra {
namespace {

std::filesystem::path File(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

cv::Mat1f Noise(uint64_t seed) {
  cv::Mat1f image(37, 53);
  RandomStream(seed).FillNormals({image.ptr<float>(), image.total()});
  image(3, 4) = std::numeric_limits<float>::quiet_NaN();
  image(5, 6) = -std::numeric_limits<float>::infinity();
  image(7, 8) = std::numeric_limits<float>::denorm_min();
  return image;
}

void ExpectSameBits(const cv::Mat1f& a, const cv::Mat1f& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data, b.data, a.total() * sizeof(float)), 0);
}

TEST(Exr, RoundTripKeepsEveryBitAndAllMetadata) {
  const std::vector<ExrChannel> channels = {{"depth.Z", Noise(1)}, {"R", Noise(2)}};
  const std::map<std::string, std::string> metadata = {{"study", "one"}, {"trial", "1/2"}};
  WriteExr(File("round.exr"), channels, metadata);
  const ExrImage image = ReadExr(File("round.exr"));
  ASSERT_EQ(image.channels.size(), 2u);
  EXPECT_EQ(image.channels[0].name, "R");  // Sorted by name.
  ExpectSameBits(image.channels[0].values, channels[1].values);
  ExpectSameBits(image.channels[1].values, channels[0].values);
  EXPECT_EQ(image.metadata, metadata);
}

TEST(Exr, APartOfALargerImageIsWritten) {
  const cv::Mat1f all = Noise(3);
  const cv::Mat1f part = all(cv::Rect(10, 5, 20, 15));
  WriteExr(File("part.exr"), {{"Y", part}}, {});
  ExpectSameBits(ReadExr(File("part.exr")).channels[0].values, part.clone());
}

TEST(Exr, BadImagesAreRefusedWithAllFaults) {
  try {
    WriteExr(File("bad.exr"), {{"Y", Noise(1)}, {"Y", cv::Mat1f(2, 2)}, {"", Noise(2)}}, {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3u) << error.what();
  }
  EXPECT_THROW(WriteExr(File("bad.exr"), {}, {}), InputError);
  EXPECT_THROW(WriteExr(File("bad.exr"), {{"Y", Noise(1)}}, {{"compression", "none"}}), InputError);
  EXPECT_FALSE(std::filesystem::exists(File("bad.exr")));
}

TEST(Exr, ASmallFileThatClaimsToBeHugeIsRefusedBeforeAnythingIsAllocated) {
  WriteExr(File("huge.exr"), {{"A", Noise(1)}, {"B", Noise(2)}}, {});
  std::ifstream stream(File("huge.exr"), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  // The attribute's name and type, its size, then x and y of the first and of the last pixel.
  const std::string window("dataWindow\0box2i", 16);
  const size_t last_pixel = bytes.find(window) + window.size() + 1 + 4 + 8;
  // Each side is allowed; 2 * 16000² values are not.
  const std::array<int32_t, 2> claim = {15999, 15999};
  std::memcpy(bytes.data() + last_pixel, claim.data(), sizeof claim);
  std::ofstream(File("huge.exr"), std::ios::binary) << bytes;
  try {
    ReadExr(File("huge.exr"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("2 channels of 16000 x 16000 px are more than"),
              std::string::npos)
        << error.what();
  }
}

TEST(Exr, DamagedFilesAreRefused) {
  EXPECT_THROW(ReadExr(File("missing.exr")), InputError);
  std::ofstream(File("text.exr")) << "not an image";
  EXPECT_THROW(ReadExr(File("text.exr")), InputError);
  WriteExr(File("cut.exr"), {{"Y", Noise(1)}}, {});
  std::filesystem::resize_file(File("cut.exr"), std::filesystem::file_size(File("cut.exr")) / 2);
  EXPECT_THROW(ReadExr(File("cut.exr")), InputError);
}

}  // namespace
}  // namespace fenestra
