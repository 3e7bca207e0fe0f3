#include "core/io/did_you_mean.h"

#include <gtest/gtest.h>

#include <vector>

namespace fenestra {
namespace {

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
