#include "vision/frame/measurement/side_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace fenestra {
namespace {

// A camera before a frame of 1.2 m x 1 m, which covers 240 x 200 pixels of its image.
CameraView ViewOf(const cv::Mat1b& image) {
  return {CameraModel::Pinhole(400, 320, 600.0), Pose(), image};
}

FrameRectangle SampledFrame() {
  FrameRectangle frame;
  frame.R_LO = RotationFromVector({M_PI, 0.0, 0.0});
  frame.p_LO = {0.0, 0.0, 3.0};
  frame.width_m = 1.2;
  frame.height_m = 1.0;
  frame.border_m = 0.1;
  return frame;
}

SideRequest RequestOf(Side side, bool coarse = false) {
  return {.side = side,
          .border = Border::kOuter,
          .brighter = Brighter::kOutside,
          .reach_px = 4.0,
          .far_px = 8.0,
          .min_contrast_dn = 6.0,
          .vignetting = {.black_dn = 8.0, .power = 0.0},
          .coarse = coarse};
}

// Grey values that rise by one from column to column.
cv::Mat1b Columns() {
  cv::Mat1b image(320, 400);
  for (int u = 0; u < image.cols; ++u) image.col(u) = static_cast<uchar>(u % 256);
  return image;
}

TEST(SideSampling, StripsFollowTheSideAndTheirNormalsLookOutwards) {
  const cv::Mat1b image = Columns();
  // 199.5 ± 120 columns, 159.5 ± 100 rows.
  const std::array<Eigen::Vector2d, 4> outwards = {Eigen::Vector2d(0, -1), {1, 0}, {0, 1}, {-1, 0}};
  const std::array<double, 4> places = {159.5 - 100.0, 199.5 + 120.0, 159.5 + 100.0, 199.5 - 120.0};
  for (const Side side : kAllSides) {
    const auto i = static_cast<size_t>(side);
    const EdgeStrips cut = CutStrips(ViewOf(image), SampledFrame(), RequestOf(side));
    ASSERT_FALSE(cut.strips.empty());
    EXPECT_EQ(cut.places, static_cast<int>(cut.strips.size()));
    double before = -1.0;
    for (const EdgeStrip& strip : cut.strips) {
      EXPECT_LT((strip.normal - outwards[i]).norm(), 1e-9);
      EXPECT_NEAR(strip.pixel[i % 2 == 0 ? 1 : 0], places[i], 1e-9);
      EXPECT_GT(strip.share, before);
      before = strip.share;
    }
  }
}

TEST(SideSampling, StripsAreAboutEightPixelsLongAndEndBeforeTheCorners) {
  const EdgeStrips cut = CutStrips(ViewOf(Columns()), SampledFrame(), RequestOf(Side::kRight));
  // 200 px less 5 px at either end: 23 strips.
  EXPECT_EQ(cut.strips.size(), 23u);
  const double half_strip = 0.5 / 23.0 * 190.0 / 200.0;
  EXPECT_NEAR(cut.strips.front().share, 5.0 / 200.0 + half_strip, 1e-9);
  EXPECT_NEAR(cut.strips.back().share, 1.0 - 5.0 / 200.0 - half_strip, 1e-9);
}

TEST(SideSampling, PixelsReachAsFarAsTheRequestSays) {
  const EdgeStrips cut = CutStrips(ViewOf(Columns()), SampledFrame(), RequestOf(Side::kRight));
  for (const EdgeStrip& strip : cut.strips) {
    std::set<double> distances;
    for (const StripPixel& pixel : strip.pixels) {
      distances.insert(pixel.s_px);
      // Column 319.5 is the edge; a pixel's grey value is its column.
      EXPECT_EQ(pixel.grey_dn, std::fmod(319.5 + pixel.s_px, 256.0));
    }
    // 4 px inside and, away from the border, 8 px outside: pixels at halves.
    EXPECT_EQ(*distances.begin(), -3.5);
    EXPECT_EQ(*distances.rbegin(), 7.5);
    EXPECT_EQ(distances.size(), 12u);
  }
}

TEST(SideSampling, OfTheInnerEdgeTheFarPixelsAreInTheOpening) {
  SideRequest request = RequestOf(Side::kRight);
  request.border = Border::kInner;
  const EdgeStrips cut = CutStrips(ViewOf(Columns()), SampledFrame(), request);
  ASSERT_FALSE(cut.strips.empty());
  double least = 0.0;
  double most = 0.0;
  for (const StripPixel& pixel : cut.strips.front().pixels) {
    least = std::min(least, pixel.s_px);
    most = std::max(most, pixel.s_px);
  }
  EXPECT_LT(least, -7.0);
  EXPECT_LE(most, 4.0);
}

// Every third one, and the same ones from whichever end they are counted.
TEST(SideSampling, ACoarseRequestTakesEveryThirdStripSymmetrically) {
  FrameRectangle large = SampledFrame();
  large.height_m = 1.5;
  const EdgeStrips all = CutStrips(ViewOf(Columns()), large, RequestOf(Side::kRight));
  const EdgeStrips some = CutStrips(ViewOf(Columns()), large, RequestOf(Side::kRight, true));
  ASSERT_GE(all.strips.size(), 30u);
  EXPECT_NEAR(static_cast<double>(some.strips.size()), static_cast<double>(all.strips.size()) / 3.0,
              1.0);
  for (size_t i = 0; i < some.strips.size(); ++i) {
    const EdgeStrip& mirrored = some.strips[some.strips.size() - 1 - i];
    EXPECT_NEAR(some.strips[i].share, 1.0 - mirrored.share, 1e-9);
  }
  // Of few strips none is spared.
  EXPECT_EQ(CutStrips(ViewOf(Columns()), SampledFrame(), RequestOf(Side::kRight, true)).places, 23);
}

TEST(SideSampling, StripsOutsideOfTheImageAreCountedAndLeftOut) {
  FrameRectangle cut_off = SampledFrame();
  cut_off.p_LO.x() = 0.4;  // 80 px: the right side leaves the image, the upper one in part.
  const EdgeStrips right = CutStrips(ViewOf(Columns()), cut_off, RequestOf(Side::kRight));
  EXPECT_TRUE(right.strips.empty());
  EXPECT_GT(right.places, 0);
  const EdgeStrips top = CutStrips(ViewOf(Columns()), cut_off, RequestOf(Side::kTop));
  EXPECT_GT(top.strips.size(), 0u);
  EXPECT_LE(top.strips.size(), static_cast<size_t>(top.places));
  cut_off.p_LO.z() = -3.0;
  EXPECT_EQ(CutStrips(ViewOf(Columns()), cut_off, RequestOf(Side::kTop)).places, 0);
}

// Across the right side the grey value falls by one for each pixel inwards, 1/200 m.
TEST(SideSampling, AProfileIsTheMeanAlongTheSide) {
  const ProfileGrid grid{.first_m = 0.0, .step_m = 0.01, .count = 20};
  const SideProfile profile = ProfileAcross(ViewOf(Columns()), SampledFrame(), Side::kRight, grid);
  ASSERT_EQ(profile.size(), 20);
  for (int i = 0; i < profile.size(); ++i) {
    EXPECT_NEAR(profile.Grey(i), 319.5 - 256.0 - 2.0 * i, 1e-9) << i;
    // All alike along the side: rounding alone, over 140 pixels of which 64 are read.
    EXPECT_NEAR(profile.Variance(i), 1.0 / 12.0 / 64.0, 1e-9) << i;
  }
  EXPECT_EQ(grid.InsetAt(3), 0.03);
}

TEST(SideSampling, AProfileOutsideOfTheImageIsUncertain) {
  FrameRectangle aside = SampledFrame();
  aside.p_LO.x() = 5.0;
  const SideProfile profile = ProfileAcross(ViewOf(Columns()), aside, Side::kRight,
                                            {.first_m = 0.0, .step_m = 0.01, .count = 2});
  EXPECT_GT(profile.Variance(0), 1e6);
}

// z/f a pixel, larger by 1/cos where the frame is turned away.
TEST(SideSampling, APixelCoversMoreOfATurnedFrame) {
  const double facing_m = PixelAcross(ViewOf(Columns()), SampledFrame(), Side::kTop);
  EXPECT_NEAR(facing_m, 3.0 / 600.0, 1e-6);
  FrameRectangle turned = SampledFrame();
  turned.R_LO = RotationFromVector({0.0, M_PI / 3.0, 0.0}) * turned.R_LO;
  const double aside_m = 0.5 * (PixelAcross(ViewOf(Columns()), turned, Side::kLeft) +
                                PixelAcross(ViewOf(Columns()), turned, Side::kRight));
  EXPECT_NEAR(aside_m, 2.0 * facing_m, 0.2 * facing_m);
  FrameRectangle behind = SampledFrame();
  behind.p_LO.z() = -3.0;
  EXPECT_EQ(PixelAcross(ViewOf(Columns()), behind, Side::kTop), 0.0);
}

}  // namespace
}  // namespace fenestra
