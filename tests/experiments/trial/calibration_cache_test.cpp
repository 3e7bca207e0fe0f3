#include "experiments/trial/calibration_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "experiments/study/trial_settings.h"
#include "experiments/trial/calibrated_rig.h"
#include "sim/stereo/stereo_rig.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using testing::ReadFile;
using testing::TemporaryFolder;

// A calibration whose numbers have no short decimal form.
CalibrationWithCovariance Odd() {
  StereoCalibration calibration = DesignOf(StereoRigOptions());
  calibration.X_RL = Pose(RotationFromVector({0.01 / 3.0, -0.02 / 7.0, 0.0}), {-1.05 / 3.0, 0, 0});
  PairMatrix covariance = PairMatrix::Constant(1e-9 / 3.0);
  covariance(0, 23) = -1e-300 / 7.0;
  return {calibration, covariance};
}

// Asks for the calibration of `content`, and whether it had to be computed.
struct CacheAnswer {
  CalibrationWithCovariance calibration;
  bool computed = false;
};

CacheAnswer Ask(const CalibrationCache& cache, const std::string& content) {
  CacheAnswer answer{.calibration = {DesignOf(StereoRigOptions()), PairMatrix::Zero()}};
  answer.calibration = cache.Get(content, [&answer] {
    answer.computed = true;
    return Odd();
  });
  return answer;
}

size_t FilesIn(const std::filesystem::path& folder) {
  return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

// Another value of an environment variable, until the end of the scope.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Environment() {
    if (before_) setenv(name_, before_->c_str(), 1);
    if (!before_) unsetenv(name_);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::filesystem::path OnlyFile(const TemporaryFolder& folder) {
  return std::filesystem::directory_iterator(folder.path())->path();
}

TEST(CalibrationCacheTest, TheSameContentIsComputedOnceAndReadToTheBit) {
  const TemporaryFolder folder;
  const CalibrationCache cache(folder.path());
  EXPECT_TRUE(Ask(cache, "a rig\nits boards\n").computed);
  const CacheAnswer again = Ask(CalibrationCache(folder.path()), "a rig\nits boards\n");
  EXPECT_FALSE(again.computed);
  EXPECT_EQ(again.calibration, Odd());
  EXPECT_TRUE(Ask(cache, "another rig\n").computed);
}

TEST(CalibrationCacheTest, EachContentHasAFileOfItsOwn) {
  const TemporaryFolder folder;
  const CalibrationCache cache(folder.path());
  const StereoRig rig({}, RandomStream(1));
  CalibrationChoice choice;
  Ask(cache, ContentOf(rig, choice, RandomStream(2)));
  Ask(cache, ContentOf(rig, choice, RandomStream(2)));
  EXPECT_EQ(FilesIn(folder.path()), 1u);
  choice.boards += 1;
  EXPECT_TRUE(Ask(cache, ContentOf(rig, choice, RandomStream(2))).computed);
  EXPECT_EQ(FilesIn(folder.path()), 2u);
}

TEST(CalibrationCacheTest, TheUserSaysWhereItIs) {
  const TemporaryFolder folder;
  const Environment place("FENESTRA_CACHE", (folder / "cache").string());
  const Environment other("XDG_CACHE_HOME", (folder / "other").string());
  EXPECT_TRUE(Ask(CalibrationCache::OfUser(), "a rig\n").computed);
  EXPECT_FALSE(Ask(CalibrationCache::OfUser(), "a rig\n").computed);
  EXPECT_EQ(FilesIn(folder / "cache"), 1u);
  EXPECT_FALSE(std::filesystem::exists(folder / "other"));
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
  std::vector<std::string> damaged = {std::string(1 << 20, '\0'), one_digit, good + good, "K1: [",
                                      good + "\n"};
  for (size_t length = 0; length < good.size(); length += 97) {
    damaged.push_back(good.substr(0, length));
  }
  damaged.push_back(good.substr(0, good.size() - 1));
  for (const std::string& bad : damaged) {
    std::ofstream(file, std::ios::binary) << bad;
    const CacheAnswer answer = Ask(cache, "a rig\n");
    EXPECT_TRUE(answer.computed);
    EXPECT_EQ(answer.calibration, Odd());
    EXPECT_EQ(ReadFile(file), good);
  }
}

TEST(CalibrationCacheTest, AFolderInTheFilesPlaceDoesNoHarm) {
  const TemporaryFolder folder;
  const CalibrationCache cache(folder.path());
  Ask(cache, "a rig\n");
  const std::filesystem::path file = OnlyFile(folder);
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  EXPECT_EQ(Ask(cache, "a rig\n").calibration, Odd());
}

TEST(CalibrationCacheTest, WithoutAPlaceToKeepThemAllAreComputed) {
  EXPECT_TRUE(Ask(CalibrationCache(), "a rig\n").computed);
  const CalibrationCache nowhere("/proc/no such folder");
  EXPECT_TRUE(Ask(nowhere, "a rig\n").computed);
  EXPECT_TRUE(Ask(nowhere, "a rig\n").computed);
}

TEST(CalibrationCacheTest, VariablesThatNameNoPlaceArePassedOver) {
  const TemporaryFolder folder;
  const Environment home("HOME", folder.path().string());
  for (const char* no_place : {"", "relative", "./relative"}) {
    const Environment own("FENESTRA_CACHE", no_place);
    const Environment xdg("XDG_CACHE_HOME", no_place);
    Ask(CalibrationCache::OfUser(), std::string("a rig\n") + no_place);
    EXPECT_FALSE(std::filesystem::exists("relative"));
    EXPECT_FALSE(std::filesystem::exists("fenestra"));
  }
  EXPECT_EQ(FilesIn(folder / ".cache/fenestra"), 3u);
  const Environment nowhere("HOME", "");
  const Environment own("FENESTRA_CACHE", "");
  const Environment xdg("XDG_CACHE_HOME", "");
  Ask(CalibrationCache::OfUser(), "b rig\n");
  EXPECT_TRUE(Ask(CalibrationCache::OfUser(), "b rig\n").computed);
}

}  // namespace
}  // namespace fenestra
