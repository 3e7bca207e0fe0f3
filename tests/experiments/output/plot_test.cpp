#include "experiments/output/plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

using ::testing::ElementsAre;

// Where a diagram of these axes puts its points: the mean place of those pixels that have the
// colour, which no text and no grid has.
const cv::Scalar kMark(0, 0, 255);

cv::Mat3b Canvas() {
  return WhiteCanvas({640, 460});
}

PlotLayout Layout(const PlotAxis& x, const PlotAxis& y) {
  return {.area = {0, 0, 640, 460}, .title = "", .x = x, .y = y};
}

int Marked(const cv::Mat3b& canvas) {
  cv::Mat1b mask;
  cv::inRange(canvas, kMark, kMark, mask);
  return cv::countNonZero(mask);
}

cv::Point2d PlaceOf(const PlotLayout& layout, cv::Point2d point) {
  cv::Mat3b canvas = Canvas();
  Plot(canvas, layout).Points(std::vector<cv::Point2d>{point}, kMark);
  cv::Mat1b mask;
  cv::inRange(canvas, kMark, kMark, mask);
  const cv::Moments m = cv::moments(mask, true);
  return {m.m10 / m.m00, m.m01 / m.m00};
}

TEST(RoundTicksTest, AreRoundAndWithinTheirEnds) {
  EXPECT_THAT(RoundTicks(0.0, 1.0, 5), ElementsAre(0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0));
  EXPECT_THAT(RoundTicks(0.0, 1036.0, 6), ElementsAre(0.0, 200.0, 400.0, 600.0, 800.0, 1000.0));
  EXPECT_THAT(RoundTicks(-0.71, 0.71, 3), ElementsAre(-0.5, 0.0, 0.5));
  EXPECT_THAT(RoundTicks(33.0, 34.9, 2), ElementsAre(33.0, 34.0));
}

TEST(RoundTicksTest, ZeroHasNoSign) {
  for (const double tick : RoundTicks(-1.0, 1.0, 4))
    EXPECT_FALSE(tick == 0.0 && std::signbit(tick));
}

TEST(RoundTicksTest, AreAFewWhateverTheScale) {
  for (double span = 1e-12; span < 1e12; span *= 1.37) {
    const std::vector<double> ticks = RoundTicks(-0.3 * span, 0.7 * span, 6);
    // A step is at least a sixth of the span, and less than 2.5 times that.
    EXPECT_GE(ticks.size(), 2u) << span;
    EXPECT_LE(ticks.size(), 7u) << span;
    EXPECT_GE(ticks.front(), -0.3 * span * (1.0 + 1e-9));
    EXPECT_LE(ticks.back(), 0.7 * span * (1.0 + 1e-9));
  }
}

TEST(RoundTicksTest, EndForRangesThatAreNone) {
  EXPECT_TRUE(RoundTicks(1.0, 1.0, 6).empty());
  EXPECT_TRUE(RoundTicks(2.0, 1.0, 6).empty());
  EXPECT_TRUE(RoundTicks(0.0, std::nan(""), 6).empty());
  EXPECT_TRUE(RoundTicks(0.0, HUGE_VAL, 6).empty());
  EXPECT_LE(RoundTicks(1e17, 1e17 + 32.0, 6).size(), 7u);
}

TEST(PlotTest, PointsGrowToTheRightAndUpwardsInProportion) {
  const PlotLayout layout = Layout({"x", 0.0, 10.0}, {"y", -1.0, 1.0});
  const cv::Point2d low = PlaceOf(layout, {2.5, -0.5});
  const cv::Point2d middle = PlaceOf(layout, {5.0, 0.0});
  const cv::Point2d high = PlaceOf(layout, {7.5, 0.5});
  EXPECT_GT(middle.x, low.x);
  EXPECT_LT(middle.y, low.y);  // Rows grow downwards.
  // Drawn to a sixteenth of a pixel; the centre of its full pixels is within half of one.
  EXPECT_NEAR(high.x - middle.x, middle.x - low.x, 1.0);
  EXPECT_NEAR(high.y - middle.y, middle.y - low.y, 1.0);
}

TEST(PlotTest, DecadesOfALogarithmicAxisAreEquallyLong) {
  const PlotLayout layout = Layout({"x", 1.0, 1e4, true}, {"y", 0.0, 1.0});
  const double first = PlaceOf(layout, {10.0, 0.5}).x;
  const double second = PlaceOf(layout, {100.0, 0.5}).x;
  const double third = PlaceOf(layout, {1000.0, 0.5}).x;
  EXPECT_GT(second, first + 50.0);
  EXPECT_NEAR(third - second, second - first, 1.0);
}

TEST(PlotTest, WhatIsOutsideTheAxesIsNotDrawn) {
  for (const bool logarithmic : {false, true}) {
    cv::Mat3b canvas = Canvas();
    Plot plot(canvas, Layout({"x", 1.0, 10.0, logarithmic}, {"y", 1.0, 10.0, logarithmic}));
    const cv::Mat3b empty = canvas.clone();
    plot.Points(
        std::vector<cv::Point2d>{{0.9, 5}, {11, 5}, {5, 0}, {5, 11}, {-5, 5}, {NAN, 5}, {5, NAN}},
        kMark);
    plot.Line(std::vector<cv::Point2d>{{5, 5}, {5, 20}, {NAN, 5}, {0, 0}}, kMark);
    plot.VerticalMark(11.0, "outside");
    plot.VerticalMark(NAN, "nowhere");
    EXPECT_EQ(cv::norm(canvas, empty, cv::NORM_INF), 0.0);
    plot.Points(std::vector<cv::Point2d>{{5, 5}}, kMark);
    EXPECT_GT(Marked(canvas), 0);
  }
}

TEST(PlotTest, APlotStaysInItsPart) {
  cv::Mat3b canvas = WhiteCanvas({1280, 460});
  PlotLayout layout =
      Layout({"photons per pixel", 1.0, 1e5, true}, {"signal to noise", 0.5, 300, true});
  layout.title = "Signal to noise: largest 41.8 dB, dynamic range 55.3 dB";
  Plot plot(canvas, layout);
  plot.Points(std::vector<cv::Point2d>{{1.0, 0.5}, {100.0, 10.0}}, plot_color::kBlue, "pairs");
  plot.Line(std::vector<cv::Point2d>{{1.0, 1.0}, {1e5, 300.0}}, plot_color::kGreen, "model");
  plot.VerticalMark(5e4, "saturation");
  const cv::Mat other = canvas(cv::Rect(640, 0, 640, 460));
  EXPECT_EQ(cv::norm(other, WhiteCanvas({640, 460}), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace fenestra
