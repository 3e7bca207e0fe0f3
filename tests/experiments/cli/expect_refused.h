#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/experiments/cli/program.h"

namespace fenestra {

/// Exit code 2, one line (and the pointer to the help, if the line is CLI11's), and no file.
inline void ExpectRefused(const std::string& arguments, const std::string& message,
                          const std::filesystem::path& out) {
  const ProgramOutput outcome = Fenestra(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.text;
  EXPECT_THAT(outcome.text, ::testing::HasSubstr(message)) << arguments;
  EXPECT_THAT(outcome.text, ::testing::Not(::testing::HasSubstr("terminate"))) << arguments;
  EXPECT_LT(outcome.text.size(), 500u) << arguments;
  std::string lines = outcome.text;
  if (const size_t help = lines.find("See 'fenestra "); help != std::string::npos) {
    lines.resize(help);
  }
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1) << arguments << "\n" << outcome.text;
  EXPECT_TRUE(!std::filesystem::exists(out) || std::filesystem::is_empty(out)) << arguments;
}

}  // namespace fenestra
