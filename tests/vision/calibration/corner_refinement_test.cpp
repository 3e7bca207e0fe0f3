#include "vision/calibration/corner_refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr int kFine = 8;
constexpr double kBlur_px = 0.5;
constexpr double kRadius_px = 8.0;
// Edges are drawn to a sixteenth of a pixel at each place along them, and grey values rounded: over
// the window's 16 rows that averages out to some hundredths.
constexpr double kDrawn_px = 0.02;

// Where four squares of a chessboard meet; the directions of its edges.
struct Corner {
  Vector2d pixel;
  double row_deg;
  double column_deg;

  static Vector2d Direction(double angle_deg) {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    return {std::cos(angle), std::sin(angle)};
  }
  CornerGuess Guess(const Vector2d& off_px = Vector2d::Zero()) const {
    return {.pixel = pixel + off_px,
            .along_row = Direction(row_deg),
            .along_column = 3.0 * Direction(column_deg),
            .radius_px = kRadius_px};
  }
};

struct Light {
  double dark_dn = 30.0;
  double bright_dn = 170.0;
  Vector2d slope_dn = Vector2d::Zero();  // Per pixel.
};

// Squares drawn finely, blurred, and gathered by pixels.
cv::Mat1b Draw(const Corner& corner, const Light& light = {}) {
  const Vector2d row = Corner::Direction(corner.row_deg);
  const Vector2d column = Corner::Direction(corner.column_deg);
  cv::Mat1f fine(40 * kFine, 40 * kFine);
  for (int v = 0; v < fine.rows; ++v) {
    for (int u = 0; u < fine.cols; ++u) {
      const Vector2d p = Vector2d(u + 0.5, v + 0.5) / kFine - Vector2d(0.5, 0.5) - corner.pixel;
      const bool below_row = row.x() * p.y() - row.y() * p.x() > 0.0;
      const bool right_of_column = column.y() * p.x() - column.x() * p.y() > 0.0;
      fine(v, u) = static_cast<float>(
          (below_row == right_of_column ? light.dark_dn : light.bright_dn) + light.slope_dn.dot(p));
    }
  }
  cv::GaussianBlur(fine, fine, {}, kFine * kBlur_px);
  cv::Mat1f image;
  cv::resize(fine, image, {40, 40}, 0.0, 0.0, cv::INTER_AREA);
  cv::Mat1b rounded;
  image.convertTo(rounded, CV_8U);
  return rounded;
}

double ErrorOf(const cv::Mat1b& image, const Corner& corner, const Vector2d& off_px = {0.4, -0.3}) {
  const auto found = RefineCorner(image, corner.Guess(off_px));
  EXPECT_TRUE(found.has_value());
  return found ? (*found - corner.pixel).norm() : 1e9;
}

TEST(CornerRefinement, CornersAreFoundWhereverTheyStandBetweenPixels) {
  for (const double u : {0.0, 0.125, 0.375, 0.5, 0.75}) {
    for (const double v : {0.0, 0.25, 0.625}) {
      const Corner corner{{19.0 + u, 20.0 + v}, 0.0, 90.0};
      EXPECT_LT(ErrorOf(Draw(corner), corner), kDrawn_px) << u << ", " << v;
    }
  }
}

TEST(CornerRefinement, TurnedAndSkewedCornersAreFoundAlike) {
  for (const auto& [row_deg, column_deg] :
       {std::pair{7.0, 97.0}, {-20.0, 70.0}, {40.0, 130.0}, {5.0, 75.0}, {-10.0, 100.0}}) {
    const Corner corner{{19.3, 20.4}, row_deg, column_deg};
    EXPECT_LT(ErrorOf(Draw(corner), corner), kDrawn_px) << row_deg << ", " << column_deg;
  }
}

TEST(CornerRefinement, TheGuessDoesNotMatter) {
  const Corner corner{{19.3, 20.4}, 7.0, 97.0};
  const cv::Mat1b image = Draw(corner);
  const auto from_truth = RefineCorner(image, corner.Guess());
  ASSERT_TRUE(from_truth.has_value());
  for (const Vector2d& off_px : {Vector2d(1.5, 0.5), Vector2d(-1.0, 1.0), Vector2d(0.0, -1.5)}) {
    const auto found = RefineCorner(image, corner.Guess(off_px));
    ASSERT_TRUE(found.has_value()) << off_px.transpose();
    // Its iterations end at 1e-4 px, but the window, and so the weights, are the guess's.
    EXPECT_LT((*found - *from_truth).norm(), 0.01) << off_px.transpose();
  }
}

TEST(CornerRefinement, LightAndItsSlopeDoNotMatter) {
  const Corner corner{{19.3, 20.4}, 7.0, 97.0};
  const Light even;
  Light reversed;
  std::swap(reversed.dark_dn, reversed.bright_dn);
  const Light dim{.dark_dn = 20.0, .bright_dn = 50.0};
  const Light uneven{.slope_dn = {3.0, -2.0}};
  for (const Light& light : {even, reversed, dim, uneven}) {
    EXPECT_LT(ErrorOf(Draw(corner, light), corner), kDrawn_px);
  }
}

TEST(CornerRefinement, WithoutContrastThereIsNoCorner) {
  const Corner corner{{19.3, 20.4}, 7.0, 97.0};
  EXPECT_FALSE(RefineCorner(Draw(corner, {.dark_dn = 90.0, .bright_dn = 92.0}), corner.Guess()));
  EXPECT_FALSE(RefineCorner(cv::Mat1b(40, 40, uchar{90}), corner.Guess()));
}

TEST(CornerRefinement, AWindowThatLeavesTheImageIsRefused) {
  const Corner corner{{5.0, 20.0}, 0.0, 90.0};
  EXPECT_FALSE(RefineCorner(Draw(corner), corner.Guess()));
}

TEST(CornerRefinement, AnEdgeAloneIsNoCorner) {
  cv::Mat1b image(40, 40, uchar{30});
  image.colRange(20, 40) = 170;
  const Corner corner{{19.5, 20.0}, 0.0, 90.0};
  EXPECT_FALSE(RefineCorner(image, corner.Guess()));
}

}  // namespace
}  // namespace fenestra
