#include "vision/frame/detection/edge_segments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr EdgeSegmentSettings kSettings{
    .min_length_px = 12.0,
    .min_darkness = 0.25,
    .most_per_side = 60,
    .darkness = {.black_dn = 8.0, .min_contrast_dn = 6.0, .reach_px = 4.0}};
constexpr double kHalf_px = 80.0;

// A dark square, turned about the image's centre, in a reveal so wide before a bright wall.
struct Picture {
  double angle_deg;
  double reveal_px;
  double wall_dn;
  double reveal_dn;
  double frame_dn;

  Vector2d centre() const { return {160.3, 119.6}; }
  Vector2d Across(Side side) const {
    const double turn = angle_deg * std::numbers::pi / 180.0;
    const double quarter = 0.5 * std::numbers::pi * static_cast<double>(side);
    return {std::sin(turn + quarter), -std::cos(turn + quarter)};
  }
};

// Areas to a quarter of a pixel, blurred as by a lens, with noise.
cv::Mat1b Draw(const Picture& picture, double noise_dn, uint64_t seed) {
  constexpr int kFine = 4;
  cv::Mat1f fine(240 * kFine, 320 * kFine);
  for (int v = 0; v < fine.rows; ++v) {
    for (int u = 0; u < fine.cols; ++u) {
      const Vector2d p = Vector2d(u + 0.5, v + 0.5) / kFine - Vector2d(0.5, 0.5);
      double out = -1e9;
      for (const Side side : kAllSides) {
        out = std::max(out, picture.Across(side).dot(p - picture.centre()) - kHalf_px);
      }
      fine(v, u) = static_cast<float>(out < 0.0                 ? picture.frame_dn
                                      : out < picture.reveal_px ? picture.reveal_dn
                                                                : picture.wall_dn);
    }
  }
  cv::Mat1f image;
  cv::resize(fine, image, cv::Size(320, 240), 0.0, 0.0, cv::INTER_AREA);
  cv::GaussianBlur(image, image, cv::Size(), 0.6);
  std::vector<float> noise(image.total());
  RandomStream(seed).FillNormals(noise);
  for (size_t i = 0; i < noise.size(); ++i) {
    image(static_cast<int>(i)) += static_cast<float>(noise_dn) * noise[i];
  }
  cv::Mat1b grey;
  image.convertTo(grey, CV_8U);
  return grey;
}

// The longest edge that lies on a side of the square, or up to `off_px` outside of it.
double LongestOn(const Picture& picture, const EdgeSegments& segments, Side side, double off_px) {
  double longest = 0.0;
  const Vector2d across = picture.Across(side);
  for (const EdgeSegment& s : segments[static_cast<size_t>(side)]) {
    const double from = across.dot(s.from - picture.centre()) - kHalf_px;
    const double to = across.dot(s.to - picture.centre()) - kHalf_px;
    if (std::min(from, to) < -0.4 || std::max(from, to) > off_px + 0.4) continue;
    longest = std::max(longest, s.Length());
  }
  return longest;
}

TEST(EdgeSegments, SidesOfADarkSquareAreWhole) {
  for (const double angle_deg : {-24.0, -10.0, 0.0, 3.0, 17.0}) {
    const Picture picture{angle_deg, 0.0, 150.0, 150.0, 20.0};
    const EdgeSegments segments = FindEdgeSegments(Draw(picture, 1.0, 1), kSettings);
    for (const Side side : kAllSides) {
      EXPECT_GT(LongestOn(picture, segments, side, 0.0), 0.93 * 2.0 * kHalf_px) << angle_deg;
    }
  }
}

// A frame that stands back, in little light: from the wall to its reveal and from there to the
// frame grey falls alike, and noise decides from row to row which of both steps is the stronger.
TEST(EdgeSegments, SideWithALitRevealIsWhole) {
  for (const double reveal_px : {2.0, 2.6}) {
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      const Picture picture{1.5, reveal_px, 66.0, 40.0, 14.0};
      const EdgeSegments segments = FindEdgeSegments(Draw(picture, 3.0, seed), kSettings);
      for (const Side side : kAllSides) {
        // A corner may be a quarter of a side beyond its end (FindDarkQuadrilaterals).
        EXPECT_GT(LongestOn(picture, segments, side, reveal_px), 0.75 * 2.0 * kHalf_px)
            << reveal_px << " px, seed " << seed << ", side " << static_cast<int>(side);
      }
    }
  }
}

// What is dark below a bright square's lower side would be the top of something dark.
TEST(EdgeSegments, BrightSquareHasNoSideOfADarkOne) {
  const Picture picture{4.0, 0.0, 40.0, 40.0, 150.0};
  const EdgeSegments segments = FindEdgeSegments(Draw(picture, 1.0, 1), kSettings);
  for (const Side side : kAllSides) EXPECT_EQ(LongestOn(picture, segments, side, 0.0), 0.0);
}

}  // namespace
}  // namespace fenestra
