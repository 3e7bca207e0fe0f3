#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace fenestra::testing {

/// A study of one trial.
inline constexpr const char* kTinyStudy =
    "name: tiny\nrepetitions: 1\nsensors: [stereo]\ndetectors: [edge-stereo]\n"
    "factors: {distance_m: 2}\n";

/// A command and names that it uses; OUT stands for the folder, WORK for one with a study, its
/// shards, its result and a recorded sequence.
struct WritingCommand {
  std::string name;
  std::string arguments;
  std::vector<std::string> files;
  bool runs_here = true;  ///< False where it takes long or needs what is not here.
};

/// Every command that writes into a folder.
const std::vector<WritingCommand>& WritingCommands();

/// What these commands need, made once for all tests of a suite.
class WritingCommandsTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();

  /// The arguments with OUT and WORK replaced.
  static std::string Placed(std::string text, const std::filesystem::path& out);

 private:
  static TemporaryFolder* work_;
};

}  // namespace fenestra::testing
