#include "core/io/faults.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace fenestra {
namespace {

// What is reported, a fault a line.
std::string Report(const Faults& faults) {
  try {
    faults.ThrowIfAny();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FaultsTest, WhatHoldsIsNoFault) {
  Faults faults("camera");
  faults.Require(true, "unused");
  faults.RequirePositive("x_m", 1e-300);
  faults.RequireNotNegative("x_m", 0.0);
  faults.RequireWithin("share", 1.0, 0.0, 1.0);
  EXPECT_EQ(faults.count(), 0u);
  EXPECT_NO_THROW(faults.ThrowIfAny());
}

TEST(FaultsTest, AllFaultsAreReportedInTheOrderInWhichTheyWereFound) {
  Faults faults("camera");
  faults.Require(false, "one");
  faults.Add("/nodes/3", "two");
  faults.AddFault({.line = 7, .message = "three"});
  faults.AddFault({.source = "lens", .message = "four"});
  EXPECT_EQ(Report(faults), "camera: one\ncamera: /nodes/3: two\ncamera:7: three\nlens: four");
}

TEST(FaultsTest, ValuesThatAreNotNumbersAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Faults faults;
  faults.RequirePositive("x", nan);
  faults.RequireNotNegative("x", nan);
  faults.RequireWithin("x", nan, 0.0, 1.0);
  EXPECT_EQ(Report(faults),
            "x must be positive, not nan\nx must be 0 or more, not nan\n"
            "x must be in [0, 1], not nan");
}

TEST(FaultsTest, SortingKeepsTheOrderOfFaultsAtOnePlace) {
  Faults faults;
  for (const int line : {2, 1, 2}) {
    faults.AddFault({.source = "f", .line = line, .message = std::to_string(faults.count())});
  }
  faults.SortByPlace();
  EXPECT_EQ(Report(faults), "f:1: 1\nf:2: 0\nf:2: 2");
}

TEST(FaultsTest, FaultsBeyondTheMostAreCounted) {
  Faults faults("f", 2);
  for (int i = 0; i < 5; ++i) faults.Add(std::to_string(i));
  EXPECT_EQ(faults.count(), 5u);
  EXPECT_EQ(Report(faults), "f: 0\nf: 1\nf: and 3 more faults");
}

const std::vector<std::string> kWords = {"distance_m", "azimuth_deg", "yaw_deg", "glass"};

TEST(DidYouMeanTest, FindsTheNearestWord) {
  EXPECT_EQ(DidYouMean("distnace_m", kWords), " Did you mean 'distance_m'?");
  EXPECT_EQ(DidYouMean("azimut_deg", kWords), " Did you mean 'azimuth_deg'?");
  EXPECT_EQ(DidYouMean("glas", kWords), " Did you mean 'glass'?");
}

TEST(DidYouMeanTest, ANameWithoutItsUnitIsNear) {
  EXPECT_EQ(DidYouMean("distance", kWords), " Did you mean 'distance_m'?");
}

TEST(DidYouMeanTest, KeepsSilentWhereNothingIsNear) {
  EXPECT_EQ(DidYouMean("reflectance", kWords), "");
  EXPECT_EQ(DidYouMean("", kWords), "");
  EXPECT_EQ(DidYouMean(std::string(100000, 'x'), kWords), "");
}

}  // namespace
}  // namespace fenestra
