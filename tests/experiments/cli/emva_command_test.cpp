// `fenestra emva` as a user meets it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/io/image_io.h"
#include "tests/experiments/cli/expect_refused.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::ReadFile;
using testing::TemporaryFolder;

TEST(EmvaCommandTest, TheHelpListsItAndItsOptions) {
  EXPECT_THAT(Fenestra("--help").text, HasSubstr("emva"));
  const std::string emva = Fenestra("emva --help").text;
  for (const char* option :
       {"DIR", "--evaluate-only", "--output-bits", "--gain", "--wavelength-nm", "--exposures",
        "--frames", "--width-px", "--height-px", "--set", "--seed"}) {
    EXPECT_THAT(emva, HasSubstr(option));
  }
}

TEST(EmvaCommandTest, TakesASeriesAndEvaluatesItAgain) {
  const TemporaryFolder folder;
  const std::string in = folder.path().string();
  const ProgramOutput outcome =
      Fenestra("emva " + in + " --width-px 64 --height-px 48 --exposures 50 --frames 8");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("put in"), HasSubstr("photon_transfer.png")));
  EXPECT_THAT(ReadFile(folder / "emva1288.txt"), HasSubstr("v 4.0"));
  const auto first = nlohmann::json::parse(ReadFile(folder / "results.json"));
  const ProgramOutput again = Fenestra("emva " + in + " --evaluate-only");
  ASSERT_EQ(again.exit_code, 0) << again.text;
  const auto second = nlohmann::json::parse(ReadFile(folder / "results.json"));
  ASSERT_EQ(first.at("figures").size(), second.at("figures").size());
  for (size_t i = 0; i < first.at("figures").size(); ++i) {
    EXPECT_EQ(first["figures"][i]["measured"], second["figures"][i]["measured"]);
  }
  EXPECT_FALSE(ReadColorImage(folder / "photon_transfer.png").empty());
}

TEST(EmvaCommandTest, WrongInputIsNamedAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string in = folder.path().string();
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"--evaluate-only", "emva1288.txt"},
           {"--evaluate-only --gain 2", "--gain: does not apply with --evaluate-only"},
           {"--set stereo_red_noise_e=3", "Did you mean 'stereo_read_noise_e'"},
           {"--set stereo_read_noise_e=low", "low"},
           {"--set stereo_read_noise_e", "FACTOR=VALUE"},
           {"--set distance_m=3", "factor of the stereo sensor"},
           {"--set stereo_gain=3", "factor of the stereo sensor"},
           {"--gain 0", "'0' is not a positive number"},
           {"--gain nan", "'nan' is not a positive number"},
           {"--exposures 2", "exposures"},
           {"--frames 1", "frames"},
           {"--width-px 0", "0 x 480 px"},
           {"--output-bits 12", "bits"},
           {"--wavelength-nm 2000", "nm"}}) {
    ExpectRefused("emva " + in + " " + arguments, message, folder.path());
  }
}

TEST(EmvaCommandTest, AFaultyDescriptorIsReportedLineByLine) {
  const TemporaryFolder folder;
  const auto file = folder.Write("emva1288.txt",
                                 "v 4.0\nn 10 64 48\nb ten 200\ni images\\a.png\n"
                                 "i images\\b.png\nd 1000\ni images\\c.png\n");
  const ProgramOutput outcome = Fenestra("emva " + folder.path().string() + " --evaluate-only");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.text, file.string() + ":3: 'ten' is not a positive number\n" + file.string() +
                              ":6: needs two files: temporal noise is their difference\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "results.json"));
}

TEST(EmvaCommandTest, AMissingFrameIsNamedAndTheFiguresOfBeforeAreKept) {
  const TemporaryFolder folder;
  const std::string in = folder.path().string();
  ASSERT_EQ(
      Fenestra("emva " + in + " --width-px 32 --height-px 24 --exposures 50 --frames 4").exit_code,
      0);
  const std::string before = ReadFile(folder / "results.json");
  std::filesystem::remove(folder / "images/bright_0003_001.png");
  const ProgramOutput outcome = Fenestra("emva " + in + " --evaluate-only");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("bright_0003_001.png"));
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
  EXPECT_EQ(ReadFile(folder / "results.json"), before);
}

}  // namespace
}  // namespace fenestra
