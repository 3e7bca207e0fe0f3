#include "vision/rgbd/paper/paper_rgbd_options.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

TEST(PaperRgbdOptions, DefaultsAreAllowedAndHoldThePapersThreshold) {
  EXPECT_NO_THROW(Validate(PaperRgbdOptions{}));
  EXPECT_EQ(PaperRgbdOptions{}.dark_below_dn, 50);
}

TEST(PaperRgbdOptions, ReportAllFaultsAtOnce) {
  PaperRgbdOptions options;
  options.support_fraction = std::numeric_limits<double>::quiet_NaN();
  options.dark_below_dn = 0;
  options.cloud = "some";
  try {
    Validate(options);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3u) << error.what();
  }
}

TEST(PaperRgbdOptions, EveryOptionCanBeSetByItsName) {
  const auto& table = PaperRgbdParameters();
  for (const ParameterInfo& info : table.infos()) {
    PaperRgbdOptions options;
    const ParameterValue value =
        info.type == ParameterInfo::Type::kSwitch ? ParameterValue(false)
        : info.type == ParameterInfo::Type::kChoice
            ? ParameterValue(info.choices.back())
            : ParameterValue(info.default_value == ParameterValue(info.max) ? info.min : info.max);
    table.Set(options, info.name, value);
    EXPECT_EQ(table.Get(options, info.name), value) << info.name;
    EXPECT_NE(table.Get(PaperRgbdOptions{}, info.name), value) << info.name;
  }
}

}  // namespace
}  // namespace fenestra
