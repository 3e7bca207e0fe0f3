#include "sim/structured_light/pattern_matching.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/io/input_error.h"
#include "core/random/random_stream.h"
#include "sim/structured_light/infrared_response.h"

namespace fenestra {
namespace {

const cv::Size kSize(160, 60);
constexpr double kLeast_px = 0.0;
constexpr double kMost_px = 64.0;

const SampledPattern& Pattern() {
  static const SampledPattern pattern(InfraredOptions{}.dot_sigma_px);
  return pattern;
}

PatternMatcher Matcher(const PatternMatchingOptions& options = {}) {
  return PatternMatcher(options, Pattern(), kSize, kLeast_px, kMost_px);
}

struct Exposure {
  double dots_dn = 300.0;
  double ambient_dn = 100.0;
  double noise_dn = 0.0;
};

// What the infra-red camera sees of a scene with this disparity in each column.
cv::Mat1w Image(const std::function<double(int u)>& disparity_px, const Exposure& exposure = {}) {
  const RandomStream stream(3);
  cv::Mat1w image(kSize);
  for (int v = 0; v < kSize.height; ++v) {
    for (int u = 0; u < kSize.width; ++u) {
      const double light =
          exposure.ambient_dn +
          exposure.dots_dn * static_cast<double>(Pattern().At(u - disparity_px(u), v));
      const double noise =
          exposure.noise_dn * stream.Normal(static_cast<uint64_t>(v * kSize.width + u));
      image(v, u) = static_cast<uint16_t>(std::clamp(std::lround(light + noise), 0L, 1023L));
    }
  }
  return image;
}

cv::Mat1w ImageOf(double disparity_px, const Exposure& exposure = {}) {
  return Image([=](int) { return disparity_px; }, exposure);
}

// Pixels whose windows lie in the image.
const cv::Rect kInside(4, 4, kSize.width - 8, kSize.height - 8);

struct Agreement {
  int matched = 0;
  int wrong = 0;  // By more than a pixel.
  double mean_error_px = 0.0;
  double largest_error_px = 0.0;
};

Agreement Compare(const PatternMatches& matches, double disparity_px) {
  Agreement agreement;
  for (int v = kInside.y; v < kInside.br().y; ++v) {
    for (int u = kInside.x; u < kInside.br().x; ++u) {
      const double found = matches.disparity_px(v, u);
      if (std::isnan(found)) continue;
      ++agreement.matched;
      const double error = found - disparity_px;
      if (std::abs(error) > 1.0) {
        ++agreement.wrong;
        continue;
      }
      agreement.mean_error_px += error;
      agreement.largest_error_px = std::max(agreement.largest_error_px, std::abs(error));
    }
  }
  agreement.mean_error_px /= std::max(1, agreement.matched - agreement.wrong);
  return agreement;
}

TEST(PatternMatching, EveryDisparityIsFoundWhereverItIsBetweenSteps) {
  const PatternMatcher matcher = Matcher();
  for (const double disparity_px : {3.0, 17.25, 31.4, 31.5, 40.1, 60.9}) {
    const Agreement agreement = Compare(matcher.Match(ImageOf(disparity_px)), disparity_px);
    EXPECT_GT(agreement.matched, 0.99 * kInside.area()) << disparity_px;
    EXPECT_EQ(agreement.wrong, 0) << disparity_px;
    // The vertex of three correlations, with the pattern's own error taken off. Single windows have
    // dots of their own; their mean has not.
    EXPECT_LT(std::abs(agreement.mean_error_px), 0.02) << disparity_px;
    EXPECT_LT(agreement.largest_error_px, 0.25) << disparity_px;
  }
}

TEST(PatternMatching, OutsideOfTheSearchNothingIsFound) {
  const Agreement agreement = Compare(Matcher().Match(ImageOf(75.0)), 75.0);
  // Windows of the pattern resemble others more than noise does, but few of them so much.
  EXPECT_LT(agreement.matched, 0.1 * kInside.area());
}

// A correlation coefficient does not depend on contrast and level.
TEST(PatternMatching, BrightnessAndContrastDoNotMatter) {
  const PatternMatcher matcher = Matcher();
  const cv::Mat1w image = ImageOf(31.3);
  const cv::Mat1w changed = 2 * image + 50;
  const PatternMatches before = matcher.Match(image);
  const PatternMatches after = matcher.Match(changed);
  for (int v = kInside.y; v < kInside.br().y; ++v) {
    for (int u = kInside.x; u < kInside.br().x; ++u) {
      EXPECT_NEAR(before.correlation(v, u), after.correlation(v, u), 1e-4f);
      const float found = before.disparity_px(v, u);
      if (std::isnan(found)) continue;
      EXPECT_NEAR(found, after.disparity_px(v, u), 1e-3f);
    }
  }
}

TEST(PatternMatching, NoiseAloneIsNotMatched) {
  const Agreement agreement =
      Compare(Matcher().Match(ImageOf(31.3, {.dots_dn = 0.0, .noise_dn = 10.0})), 31.3);
  // A window of 81 pixels correlates by chance with a deviation of 1/9: the threshold of 0.45 is
  // 4.05 of them, and 129 steps are tried: 129 Φ(-4.05) is one pixel in 300. Neighbours share their
  // windows, so that matches come in clusters.
  EXPECT_LE(agreement.matched, 0.012 * kInside.area());
  // The twin: half the threshold takes noise for the pattern.
  PatternMatchingOptions loose;
  loose.least_correlation = 0.25;
  const Agreement fooled =
      Compare(Matcher(loose).Match(ImageOf(31.3, {.dots_dn = 0.0, .noise_dn = 10.0})), 31.3);
  EXPECT_GT(fooled.matched, 0.3 * kInside.area());
}

TEST(PatternMatching, AFlatImageHasNoMatch) {
  const PatternMatches matches = Matcher().Match(ImageOf(31.3, {.dots_dn = 0.0}));
  EXPECT_EQ(Compare(matches, 31.3).matched, 0);
}

// A block that holds a part of each surface correlates with a part of its dots, and so with either,
// down to where the threshold is: each reaches beyond the edge by columns of the other's.
TEST(PatternMatching, NearAnEdgeTheGreaterPartOfTheWindowDecides) {
  constexpr int kEdge = 80;
  const cv::Mat1w image = Image([](int u) { return u < kEdge ? 20.0 : 40.0; });
  const PatternMatches matches = Matcher().Match(image);
  int on_left = 0;
  int on_right = 0;
  int rows = 0;
  for (int v = kInside.y; v < kInside.br().y; ++v, ++rows) {
    for (int u = kEdge - 10; u < kEdge + 10; ++u) {
      const double found = static_cast<double>(matches.disparity_px(v, u));
      if (std::abs(found - 20.0) < 1.0) ++on_left;
      if (std::abs(found - 40.0) < 1.0) ++on_right;
    }
  }
  // Ten columns of each, give or take what dots near the edge decide, and no hole between them.
  EXPECT_NEAR(on_left / static_cast<double>(rows), 10.0, 1.5);
  EXPECT_NEAR(on_right / static_cast<double>(rows), 10.0, 1.5);
  EXPECT_NEAR((on_left + on_right) / static_cast<double>(rows), 20.0, 0.5);
}

TEST(PatternMatching, OnlyTheRowsAskedForAreMatchedAndAlike) {
  const PatternMatcher matcher = Matcher();
  const cv::Mat1w image = ImageOf(31.3, {.noise_dn = 10.0});
  const PatternMatches all = matcher.Match(image);
  const PatternMatches some = matcher.Match(image, 3);
  for (int v = 0; v < kSize.height; ++v) {
    for (int u = 0; u < kSize.width; ++u) {
      const float found = some.disparity_px(v, u);
      if ((v - 4) % 3 != 0) {
        EXPECT_TRUE(std::isnan(found)) << u << ", " << v;
      } else if (!std::isnan(found) || !std::isnan(all.disparity_px(v, u))) {
        EXPECT_EQ(found, all.disparity_px(v, u)) << u << ", " << v;
      }
    }
  }
}

TEST(PatternMatching, WindowsThatLeaveTheImageAreNotMatched) {
  const PatternMatches matches = Matcher().Match(ImageOf(31.3));
  for (int u = 0; u < kSize.width; ++u) {
    EXPECT_TRUE(std::isnan(matches.disparity_px(3, u)));
    EXPECT_EQ(matches.correlation(3, u), -1.0f);
  }
  for (int v = 0; v < kSize.height; ++v) EXPECT_TRUE(std::isnan(matches.disparity_px(v, 3)));
}

TEST(PatternMatching, InNearModeTheSearchReachesTheNearestDistance) {
  const DisparityRange usual{
      .focal_times_baseline = 43.0, .step_px = 0.125, .nearest_m = 0.8, .farthest_m = 4.0};
  const DisparityRange near{
      .focal_times_baseline = 43.0, .step_px = 0.125, .nearest_m = 0.4, .farthest_m = 3.0};
  const PatternMatchingOptions options;
  EXPECT_EQ(options.SearchEnd(usual), 64.0);
  EXPECT_NEAR(options.SearchEnd(near), 43.0 / 0.4 + 2.0, 1e-12);
}

TEST(PatternMatching, AllFaultsOfTheOptionsAreReportedAtOnce) {
  PatternMatchingOptions options;
  EXPECT_NO_THROW(Validate(options));
  options.block_width_px = 8;
  options.block_height_px = 17;
  options.search_px = 0.0;
  options.least_correlation = 1.0;
  try {
    Validate(options);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 4u) << error.what();
  }
}

}  // namespace
}  // namespace fenestra
