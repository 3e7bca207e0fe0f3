#include "core/system/program.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace fenestra {
namespace {

TEST(ShellQuotingTest, AShellReadsTheWordBack) {
  for (const std::string word : {"plain-1.0/x", "two words", "", "it's", "$HOME `id` \\ \"q\"", "*",
                                 "a\nb", "~", "--out=#1"}) {
    const std::string command = "printf %s. " + ShellQuoted(word);
    FILE* pipe = popen(command.c_str(), "r");
    std::string text;
    for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) text += static_cast<char>(c);
    pclose(pipe);
    EXPECT_EQ(text, word + ".");
  }
  EXPECT_EQ(ShellQuoted("results/paper"), "results/paper");
}

}  // namespace
}  // namespace fenestra
