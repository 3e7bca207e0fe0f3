#include "core/io/utf8.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace fenestra {
namespace {

TEST(Utf8Test, EveryLengthOfCharacterIsText) {
  for (const std::string_view text : {"", "plain", "\xc3\xb6", "\xe2\x82\xac", "\xf0\x9f\xaa\x9f",
                                      "\xf4\x8f\xbf\xbf", "\xef\xbb\xbfwith a byte order mark"}) {
    EXPECT_FALSE(FirstNotUtf8(text)) << text;
  }
}

TEST(Utf8Test, TheFirstBadByteIsNamed) {
  // Latin-1, a lone continuation, cut short, overlong, a surrogate, above the last character.
  for (const std::string_view bad : {"\xf6", "\x80", "\xe2\x82", "\xc0\xaf", "\xe0\x80\xaf",
                                     "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff\xfe"}) {
    EXPECT_EQ(FirstNotUtf8(std::string("\xc3\xb6=") + std::string(bad)), 3u);
    EXPECT_EQ(FirstNotUtf8(std::string(bad) + " "), 0u);
  }
}

}  // namespace
}  // namespace fenestra
