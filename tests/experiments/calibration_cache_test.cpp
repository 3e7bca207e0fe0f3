#include "experiments/calibration_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim/stereo_rig.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using testing::ReadFile;
using testing::TemporaryFolder;

// A calibration whose numbers have no short decimal form.
StereoCalibration Odd() {
  StereoCalibration calibration = DesignOf({});
  calibration.X_RL = Pose(RotationFromVector({0.01 / 3.0, -0.02 / 7.0, 0.0}), {-1.05 / 3.0, 0, 0});
  return calibration;
}

// Asks for the calibration of `content`, and whether it had to be computed.
struct Answer {
  StereoCalibration calibration;
  bool computed = false;
};

Answer Ask(const CalibrationCache& cache, const std::string& content) {
  Answer answer{.calibration = DesignOf({})};
  answer.calibration = cache.Get(content, [&answer] {
    answer.computed = true;
    return Odd();
  });
  return answer;
}

std::filesystem::path OnlyFile(const TemporaryFolder& folder) {
  return std::filesystem::directory_iterator(folder.path())->path();
}

TEST(CalibrationCacheTest, TheSameContentIsComputedOnceAndReadToTheBit) {
  const TemporaryFolder folder;
  const CalibrationCache cache(folder.path());
  EXPECT_TRUE(Ask(cache, "a rig\nits boards\n").computed);
  const Answer again = Ask(CalibrationCache(folder.path()), "a rig\nits boards\n");
  EXPECT_FALSE(again.computed);
  EXPECT_EQ(again.calibration, Odd());
  EXPECT_TRUE(Ask(cache, "another rig\n").computed);
}

TEST(CalibrationCacheTest, ADamagedFileIsComputedAnew) {
  const TemporaryFolder folder;
  const CalibrationCache cache(folder.path());
  Ask(cache, "a rig\n");
  const std::filesystem::path file = OnlyFile(folder);
  const std::string good = ReadFile(file);
  std::string one_digit = good;
  const size_t digit = good.find_first_of("123456789", good.find("data"));
  ASSERT_NE(digit, std::string::npos);
  one_digit[digit] = good[digit] == '1' ? '2' : '1';
  std::string other_content = good;
  other_content.replace(good.rfind("a rig"), 5, "b rig");
  for (const std::string& bad : {std::string(), good.substr(0, good.size() / 2),
                                 good.substr(0, good.size() - 1), one_digit, other_content}) {
    std::ofstream(file, std::ios::binary) << bad;
    const Answer answer = Ask(cache, "a rig\n");
    EXPECT_TRUE(answer.computed);
    EXPECT_EQ(answer.calibration, Odd());
    EXPECT_EQ(ReadFile(file), good);
  }
}

TEST(CalibrationCacheTest, WithoutAPlaceToKeepThemAllAreComputed) {
  EXPECT_TRUE(Ask(CalibrationCache(), "a rig\n").computed);
  const CalibrationCache nowhere("/proc/no such folder");
  EXPECT_TRUE(Ask(nowhere, "a rig\n").computed);
  EXPECT_TRUE(Ask(nowhere, "a rig\n").computed);
}

}  // namespace
}  // namespace fenestra
