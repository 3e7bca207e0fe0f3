#include "experiments/output/number_format.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace fenestra {
namespace {

TEST(NumberFormat, ShowsThreeSignificantDigits) {
  EXPECT_EQ(Significant(0.0), "0");
  EXPECT_EQ(Significant(12345.6), "12346");
  EXPECT_EQ(Significant(123.4), "123");
  EXPECT_EQ(Significant(-12.34), "-12.3");
  EXPECT_EQ(Significant(1.234), "1.23");
  EXPECT_EQ(Significant(9.996), "10.0");
  EXPECT_EQ(Significant(99.96), "100");
  EXPECT_EQ(Significant(0.1234), "0.123");
  EXPECT_EQ(Significant(-0.0004), "0.000");
  EXPECT_EQ(Significant(std::nullopt), "—");
  EXPECT_EQ(Significant(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(WithStandardError(-1.2345, 0.456), "-1.23 ± 0.46");
  EXPECT_EQ(WithStandardError(1234.6, 45.6), "1235 ± 46");
  EXPECT_EQ(Percent(0.9501), "95.0 %");
}

}  // namespace
}  // namespace fenestra
