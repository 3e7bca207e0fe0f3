#include "core/detection/window_prior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/pose.h"

namespace fenestra {
namespace {

constexpr double kSideShare = 0.1;

// A rectangle 3 m in front of the camera, turned by `roll_rad` in the image and its upper right
// corner moved to the right.
WindowEstimate Window(double width_m, double height_m, double roll_rad = 0.0, double skew_m = 0.0) {
  const Pose X_CO(Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                  {0.2, -0.1, 3.0});
  const double x = 0.5 * width_m;
  const double y = 0.5 * height_m;
  WindowEstimate estimate;
  estimate.p_CO = X_CO.translation();
  estimate.p_CV = {X_CO * Eigen::Vector3d(-x, -y, 0.0), X_CO * Eigen::Vector3d(x + skew_m, -y, 0.0),
                   X_CO * Eigen::Vector3d(x, y, 0.0), X_CO * Eigen::Vector3d(-x, y, 0.0)};
  return estimate;
}

std::string Reason(const std::optional<Miss>& miss) {
  return miss ? miss->reason : "";
}

TEST(WindowPriorTest, KnowingNothingRefusesNothing) {
  const WindowPrior nothing;
  EXPECT_TRUE(FaultsOf(nothing).empty());
  EXPECT_FALSE(ObjectionOf(nothing, Window(0.1, 7.0, 0.5, 3.0), kSideShare));
  EXPECT_FALSE(ObjectionOf(nothing, 0.9));
}

TEST(WindowPriorTest, SizesMayDepartByTheMeasurementOrFiveSigma) {
  WindowPrior prior;
  prior.expected_width_m = 1.5;
  prior.expected_height_m = 1.0;
  prior.expected_size_sigma_m = 0.001;  // So a tenth of the shorter side decides: 0.1 m.
  EXPECT_EQ(Reason(ObjectionOf(prior, Window(1.59, 0.91), kSideShare)), "");
  EXPECT_EQ(Reason(ObjectionOf(prior, Window(1.61, 1.0), kSideShare)), "unexpected_size");
  EXPECT_EQ(Reason(ObjectionOf(prior, Window(1.0, 1.5), kSideShare)), "unexpected_size");
  prior.expected_size_sigma_m = 0.03;  // Now 5 σ do: 0.15 m.
  EXPECT_EQ(Reason(ObjectionOf(prior, Window(1.64, 1.0), kSideShare)), "");
  EXPECT_EQ(Reason(ObjectionOf(prior, Window(1.66, 1.0), kSideShare)), "unexpected_size");
}

TEST(WindowPriorTest, AspectDoesNotDependOnSize) {
  WindowPrior prior;
  prior.expected_aspect = 0.5;
  for (const double height_m : {0.2, 1.0, 5.0}) {
    EXPECT_FALSE(ObjectionOf(prior, Window(0.55 * height_m, height_m), kSideShare));
    EXPECT_EQ(Reason(ObjectionOf(prior, Window(height_m, height_m), kSideShare)),
              "unexpected_shape");
  }
}

TEST(WindowPriorTest, ARectangleMayBeRolledAnUprightOneMayNot) {
  WindowPrior prior;  // 15° are allowed.
  const double roll_rad = 20.0 * M_PI / 180.0;
  // The corner at a skew s over a height of 1 m is off by atan s: 0.5 is 27°.
  prior.expected_shape = ExpectedShape::kRectangle;
  EXPECT_FALSE(ObjectionOf(prior, Window(1.0, 1.0, roll_rad), kSideShare));
  EXPECT_EQ(Reason(ObjectionOf(prior, Window(1.0, 1.0, 0.0, 0.5), kSideShare)), "unexpected_shape");
  prior.expected_shape = ExpectedShape::kUprightRectangle;
  EXPECT_FALSE(ObjectionOf(prior, Window(1.0, 1.0, 0.5 * roll_rad), kSideShare));
  EXPECT_EQ(Reason(ObjectionOf(prior, Window(1.0, 1.0, roll_rad), kSideShare)), "unexpected_shape");
}

TEST(WindowPriorTest, ColourAndGreyAreWithinTheirTolerance) {
  WindowPrior prior;
  prior.expected_red_dn = 200;
  prior.expected_green_dn = 30;
  prior.expected_blue_dn = 10;
  prior.expected_color_tolerance_dn = 20;
  cv::Mat3b image(1, 4);
  image(0, 0) = {10, 30, 200};  // Blue first.
  image(0, 1) = {30, 50, 220};  // At the limit.
  image(0, 2) = {31, 30, 200};
  image(0, 3) = {200, 30, 10};
  const cv::Mat1b matching = ExpectedColor(prior, image);
  EXPECT_EQ(std::vector<uint8_t>(matching.begin(), matching.end()),
            std::vector<uint8_t>({255, 255, 0, 0}));
  prior.expected_grey_ratio = 0.1;
  EXPECT_FALSE(ObjectionOf(prior, 0.24));
  EXPECT_EQ(Reason(ObjectionOf(prior, 0.26)), "unexpected_grey");
}

TEST(WindowPriorTest, HalfSaidAndContradictoryKnowledgeIsAFault) {
  WindowPrior prior;
  prior.expected_width_m = 1.0;
  prior.expected_red_dn = 10;
  EXPECT_EQ(FaultsOf(prior).size(), 2u);
  prior = {};
  prior.expected_width_m = prior.expected_height_m = 1.0;
  prior.expected_aspect = 1.0;
  EXPECT_TRUE(FaultsOf(prior).empty());
  prior.expected_aspect = 2.0;
  EXPECT_EQ(FaultsOf(prior).size(), 1u);
}

TEST(WindowPriorTest, SensorsHaveTheOptionsThatTheyCanJudge) {
  const auto stereo = PriorParameters(SensorKind::kStereo);
  const auto rgbd = PriorParameters(SensorKind::kRgbd);
  EXPECT_NE(stereo.Find("expected_width_m"), nullptr);
  EXPECT_NE(rgbd.Find("expected_width_m"), nullptr);
  EXPECT_EQ(stereo.Find("expected_red_dn"), nullptr);
  EXPECT_EQ(rgbd.Find("expected_grey_ratio"), nullptr);
  for (const ParameterInfo& info : rgbd.infos()) EXPECT_TRUE(IsPriorOption(info.name));
}

}  // namespace
}  // namespace fenestra
