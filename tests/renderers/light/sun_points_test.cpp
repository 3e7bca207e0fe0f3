#include "renderers/light/sun_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderers/ray_caster.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

constexpr double kSun_lx = 5e4;
constexpr double kDiameter_rad = 9.3e-3;

// The part of a disc of radius 1 to one side of a line at the distance t from its centre.
double PartOfDisc(double t) {
  const double clamped = std::clamp(t, -1.0, 1.0);
  return 0.5 +
         (clamped * std::sqrt(1.0 - clamped * clamped) + std::asin(clamped)) / std::numbers::pi;
}

// Its mean over an interval.
double MeanPartOfDisc(double from, double to) {
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += PartOfDisc(from + (to - from) * (i + 0.5) / kSteps);
  return sum / kSteps;
}

// Places on the disc, in radii of it.
std::vector<Eigen::Vector2d> PlacesOf(const SunPoints& points, const Sun& sun, int lane, int turn) {
  const Eigen::Vector3d right = sun.Direction_W().unitOrthogonal();
  const Eigen::Vector3d up = sun.Direction_W().cross(right);
  std::vector<Eigen::Vector2d> places;
  for (int j = 0; j < SunPoints::kTurns; ++j) {
    RTCRay16 rays{};
    points.Aim({.turn = j}, rays);
    for (int i = 0; i < kLanes; ++i) {
      if ((lane >= 0 && i != lane) || (turn >= 0 && j != turn)) continue;
      const Eigen::Vector3d d =
          Eigen::Vector3f(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]).cast<double>();
      places.push_back(Eigen::Vector2d(d.dot(right), d.dot(up)) / (0.5 * sun.angular_diameter_rad));
    }
  }
  return places;
}

// The largest error of the share of points to one side of a line.
double WorstError(const std::vector<Eigen::Vector2d>& places) {
  double worst = 0.0;
  for (int k = 0; k < 48; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 48.0;
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    for (double t = -0.95; t < 1.0; t += 0.05) {
      const auto count = std::count_if(places.begin(), places.end(),
                                       [&](const Eigen::Vector2d& p) { return p.dot(normal) < t; });
      const double share = static_cast<double>(count) / static_cast<double>(places.size());
      worst = std::max(worst, std::abs(share - PartOfDisc(t)));
    }
  }
  return worst;
}

// A line cuts at most some 2√N of N strata and is wrong by half a point in each: by 1/√N in all.
TEST(SunPoints, LieEvenlyOnTheDiscByLaneByTurnAndTogether) {
  const Sun sun{.azimuth_rad = 0.4, .elevation_rad = 0.6};
  const SunPoints points(sun);
  for (int i = 0; i < kLanes; ++i) {
    EXPECT_LT(WorstError(PlacesOf(points, sun, i, -1)), 0.25) << i;
    EXPECT_LT(WorstError(PlacesOf(points, sun, -1, i)), 0.25) << i;
  }
  const std::vector<Eigen::Vector2d> all = PlacesOf(points, sun, -1, -1);
  EXPECT_EQ(all.size(), 256u);
  EXPECT_LT(WorstError(all), 1.0 / 16.0);
  for (const Eigen::Vector2d& p : all) EXPECT_LT(p.norm(), 1.0);
}

// A wall 2 m behind the upright edge of a plate, the sun low before both: the penumbra is 19 mm
// wide. One pixel is 1 mm: rows are means over 64 pixels along the edge.
constexpr double kBehind_m = 2.0;
constexpr double kElevation_rad = 0.2;
constexpr int kSide_px = 64;

cv::Mat1f ShadowOfAnEdge(double diameter_rad, const RenderOptions& options) {
  Scene scene;
  scene.materials = {Grey(1.0f)};
  scene.meshes = {UprightRectangle(-9, -9, 9, 9, 0.0f, 0),
                  UprightRectangle(-9, -9, 0, 9, static_cast<float>(kBehind_m), 0)};
  const RayCaster caster(scene, {.bounces = 0});
  Lighting lighting = OnlySun(0.0, kElevation_rad, kSun_lx);
  lighting.sun.angular_diameter_rad = diameter_rad;
  const RayGrid rays(CameraModel::Pinhole(kSide_px, kSide_px, 1000.0));
  const cv::Mat image =
      caster.Render(rays, FacingTheWall({0.0, 0.0, 1.0}), lighting, options, RandomStream(3));
  return image * (std::numbers::pi / (kSun_lx * std::cos(kElevation_rad)));
}

double ProfileAt(int column, double diameter_rad) {
  const double scale = 0.5 * diameter_rad * kBehind_m / std::cos(kElevation_rad);
  const double x = 1e-3 * (column - 0.5 * (kSide_px - 1));
  return MeanPartOfDisc((x - 0.5e-3) / scale, (x + 0.5e-3) / scale);
}

TEST(SunPoints, MakeThePenumbraOfAStraightEdge) {
  for (const double diameter_rad : {kDiameter_rad, 1.5e-3, 0.6e-3}) {
    const cv::Mat1f image = ShadowOfAnEdge(diameter_rad, {});
    cv::Mat1f profile;
    cv::reduce(image, profile, 0, cv::REDUCE_AVG);
    for (int u = 0; u < kSide_px; ++u) {
      const double expected = ProfileAt(u, diameter_rad);
      // 64 pixels of at least four samples with sixteen points each: five standard deviations of
      // points that were drawn at random, which these are better than.
      const double sd = std::sqrt(expected * (1.0 - expected) / (64.0 * 64.0));
      EXPECT_NEAR(static_cast<double>(profile(u)), expected, 5.0 * sd + 0.004) << u;
      for (int v = 0; v < kSide_px; ++v) {
        EXPECT_NEAR(static_cast<double>(image(v, u)), expected, 0.07) << u << " " << v;
      }
    }
    // The edge takes as much light from one side as it lets through to the other.
    EXPECT_NEAR(cv::mean(image)[0], 0.5, 0.002);
  }
}

TEST(SunPoints, OfAPointMakeAHardShadow) {
  const cv::Mat1f image = ShadowOfAnEdge(0.0, {});
  double worst = 0.0;
  for (int u = 0; u < kSide_px; ++u) {
    const double expected = u < kSide_px / 2 ? 0.0 : 1.0;
    // An edge is placed to some 0.001 px.
    EXPECT_NEAR(static_cast<double>(image(9, u)), expected, 4e-3) << u;
    worst = std::max(worst, std::abs(expected - ProfileAt(u, kDiameter_rad)));
  }
  EXPECT_GT(worst, 0.3);  // What the test above would have seen.
}

}  // namespace
}  // namespace fenestra
