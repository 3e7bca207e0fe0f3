#include "scenes/facade/wall_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

constexpr int kSide_px = kPatternSide_px;
constexpr double kTexel_m = kPatternSide_m / kPatternSide_px;

// Uniform noise on a grid, interpolated by cubics to the size of the pattern, of zero mean and unit
// variance: features of kPatternSide_m / columns by kPatternSide_m / rows.
cv::Mat1f Noise(int columns, int rows, const RandomStream& random) {
  cv::Mat1f coarse(rows, columns);
  random.FillUniforms({coarse.ptr<float>(), coarse.total()});
  cv::Mat1f fine = coarse;
  if (columns < kSide_px || rows < kSide_px) {
    constexpr int kPad = 2;  // As far as cubics reach.
    cv::Mat1f padded;
    cv::copyMakeBorder(coarse, padded, kPad, kPad, kPad, kPad, cv::BORDER_WRAP);
    const int step_x = kSide_px / columns;
    const int step_y = kSide_px / rows;
    cv::resize(padded, fine, {padded.cols * step_x, padded.rows * step_y}, 0, 0, cv::INTER_CUBIC);
    fine = fine(cv::Rect(kPad * step_x, kPad * step_y, kSide_px, kSide_px));
  }
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(fine, mean, deviation);
  return (fine - mean[0]) / deviation[0];
}

cv::Mat1f Noise(int cells, const RandomStream& random) {
  return Noise(cells, cells, random.Child("cells", static_cast<uint64_t>(cells)));
}

// Share of a texel that lies within `half_m` of a line at distance `from_line_m`.
float Covered(double from_line_m, double half_m) {
  return static_cast<float>(std::clamp((half_m - from_line_m) / kTexel_m + 0.5, 0.0, 1.0));
}

// Distance to the next multiple of `pitch_m`.
double FromGridLine(double at_m, double pitch_m) {
  return std::abs(at_m - pitch_m * std::round(at_m / pitch_m));
}

// Darkens discs, round the edges of the tile.
void DarkenDisc(double x_m, double y_m, double radius_m, float depth, cv::Mat1f& lightness) {
  const int reach = static_cast<int>(std::ceil(radius_m / kTexel_m)) + 1;
  const int x0 = static_cast<int>(std::floor(x_m / kTexel_m));
  const int y0 = static_cast<int>(std::floor(y_m / kTexel_m));
  for (int y = y0 - reach; y <= y0 + reach; ++y) {
    for (int x = x0 - reach; x <= x0 + reach; ++x) {
      const double distance_m = std::hypot((x + 0.5) * kTexel_m - x_m, (y + 0.5) * kTexel_m - y_m);
      const int row = (y + kSide_px) % kSide_px;
      const int column = (x + kSide_px) % kSide_px;
      lightness(row, column) -= depth * Covered(distance_m, radius_m);
    }
  }
}

WallPattern Plaster(const RandomStream& random) {
  cv::Mat1f lightness = 0.7 * Noise(512, random);
  lightness += 1.0 * Noise(256, random);
  lightness += 0.6 * Noise(128, random);
  lightness += 0.25 * Noise(32, random);
  lightness += 0.35 * Noise(8, random);
  lightness += 0.4 * Noise(4, random);
  lightness += 0.5 * Noise(kSide_px, random);
  return {lightness, {}};
}

// The mortar is lighter than the bricks; shades and grain stand in ratio to that difference.
WallPattern Brick(const RandomStream& random) {
  constexpr size_t kCourses = 24;
  constexpr size_t kBricksOfCourse = 8;
  constexpr double kCourse_m = kPatternSide_m / kCourses;
  constexpr double kModule_m = kPatternSide_m / kBricksOfCourse;
  constexpr double kBedJoint_m = kCourse_m - 0.071;
  constexpr double kHeadJoint_m = kModule_m - 0.240;
  constexpr float kShade = 0.30f;  // Standard deviation.
  constexpr double kGrain = 0.12;
  std::array<float, kCourses * kBricksOfCourse> shades{};
  random.Child("shades").FillNormals(shades);
  // Edges of bricks are not straight: they wander by about a millimetre.
  const cv::Mat1f wander = 0.0008 * Noise(128, random.Child("wander"));
  WallPattern brick{cv::Mat1f(kSide_px, kSide_px), cv::Mat1f(kSide_px, kSide_px)};
  for (int v = 0; v < kSide_px; ++v) {
    const double y_m = (v + 0.5) * kTexel_m;
    const size_t course = std::min(static_cast<size_t>(y_m / kCourse_m), kCourses - 1);
    const double shift_m = course % 2 == 0 ? 0.0 : 0.5 * kModule_m;
    for (int u = 0; u < kSide_px; ++u) {
      const double x_m = (u + 0.5) * kTexel_m + shift_m;
      const size_t column = static_cast<size_t>(x_m / kModule_m) % kBricksOfCourse;
      const double off = wander(v, u);
      const float joint = std::max(Covered(FromGridLine(y_m, kCourse_m) + off, 0.5 * kBedJoint_m),
                                   Covered(FromGridLine(x_m, kModule_m) + off, 0.5 * kHeadJoint_m));
      const float shade = kShade * shades[course * kBricksOfCourse + column];
      brick.lightness(v, u) = joint + (1.0f - joint) * shade;
      brick.grey(v, u) = joint;
    }
  }
  brick.lightness += kGrain * Noise(kSide_px, random.Child("grain"));
  brick.lightness += 0.5 * kGrain * Noise(128, random.Child("grain"));
  return brick;
}

WallPattern Concrete(const RandomStream& random) {
  constexpr double kPanelWidth_m = 1.0;
  constexpr double kJoint_m = 0.008;
  constexpr float kJointDepth = 3.0f;
  constexpr double kTieHole_m = 0.012;  // Radius.
  constexpr int kPores = 500;
  WallPattern concrete{0.6 * Noise(4, random), {}};
  cv::Mat1f& lightness = concrete.lightness;
  lightness += 0.5 * Noise(8, random);
  lightness += 0.4 * Noise(16, 4, random.Child("streaks"));
  lightness += 0.35 * Noise(64, random);
  lightness += 0.3 * Noise(512, random);
  lightness += 0.25 * Noise(kSide_px, random);
  for (int v = 0; v < kSide_px; ++v) {
    const double y_m = (v + 0.5) * kTexel_m;
    for (int u = 0; u < kSide_px; ++u) {
      const double x_m = (u + 0.5) * kTexel_m;
      const double from_joint_m =
          std::min(FromGridLine(x_m, kPanelWidth_m), FromGridLine(y_m, kPatternSide_m));
      lightness(v, u) -= kJointDepth * Covered(from_joint_m, 0.5 * kJoint_m);
    }
  }
  for (const double x_m : {0.25, 0.75, 1.25, 1.75}) {
    for (const double y_m : {0.5, 1.5}) DarkenDisc(x_m, y_m, kTieHole_m, kJointDepth, lightness);
  }
  const RandomStream pores = random.Child("pores");
  for (uint64_t i = 0; i < kPores; ++i) {
    const double u = pores.Uniform(3 * i + 2);
    DarkenDisc(kPatternSide_m * pores.Uniform(3 * i), kPatternSide_m * pores.Uniform(3 * i + 1),
               0.001 + 0.004 * u * u, 2.0f, lightness);
  }
  return concrete;
}

WallPattern Cladding(const RandomStream& random) {
  constexpr int kBoards = 16;
  constexpr double kBoard_m = kPatternSide_m / kBoards;
  constexpr double kJoint_m = 0.006;
  constexpr float kJointDepth = 4.0f;
  const RandomStream shades = random.Child("shades");
  WallPattern cladding{0.3 * Noise(512, 8, random.Child("grain")), {}};
  cv::Mat1f& lightness = cladding.lightness;
  lightness += 0.3 * Noise(128, 4, random.Child("wide_grain"));
  lightness += 0.2 * Noise(kSide_px, random);
  std::vector<float> across;
  for (int u = 0; u < kSide_px; ++u) {
    const double x_m = (u + 0.5) * kTexel_m;
    const auto board = static_cast<uint64_t>(x_m / kBoard_m);
    across.push_back(static_cast<float>(0.6 * shades.Normal(board)) -
                     kJointDepth * Covered(FromGridLine(x_m, kBoard_m), 0.5 * kJoint_m));
  }
  for (int v = 0; v < kSide_px; ++v) {
    for (int u = 0; u < kSide_px; ++u) lightness(v, u) += across[static_cast<size_t>(u)];
  }
  return cladding;
}

}  // namespace

WallPattern MakeWallPattern(WallFinish finish, const RandomStream& random) {
  switch (finish) {
    case WallFinish::kPlaster:
      return Plaster(random);
    case WallFinish::kBrick:
      return Brick(random);
    case WallFinish::kConcrete:
      return Concrete(random);
    case WallFinish::kCladding:
      break;
  }
  return Cladding(random);
}

}  // namespace fenestra
