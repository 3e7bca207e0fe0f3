#include "vision/rgbd/plane/frame_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

constexpr int kEvery = 3;
constexpr double kSigma = 0.002;
constexpr double kNoReturn = -1.0;

const CameraModel& Depth() {
  static const CameraModel camera = CameraModel::Pinhole(640, 480, 570.0);
  return camera;
}

FramePlaneSettings Settings() {
  return {.noise = {.sigma = kSigma,
                    .step = 0.0,
                    .window_px = 4.5,
                    .window_points = 4.5 * 4.5 / (kEvery * kEvery),
                    .window_rad = 4.5 / 570.0,
                    .image = {640, 480},
                    .farthest = 0.0},
          .clear_px = 4.0,
          .setback_m = 0.0,
          .setback_sigma_m = 0.0,
          .fits_setback = false};
}

// A frame 2 m away that faces the camera, its border 12 cm wide.
FrameRectangle Frame(double z_m = 2.0) {
  FrameRectangle frame;
  frame.R_LO = RotationFromVector({M_PI, 0.0, 0.0});
  frame.p_LO = {0.0, 0.0, z_m};
  frame.width_m = 1.0;
  frame.height_m = 0.8;
  frame.border_m = 0.12;
  return frame;
}

// How far what is seen there is behind the wall [m], by whether a place is around the frame, on its
// border or in its opening. The wall stands 2 m away.
struct Facade {
  double border_m = 0.0;
  double inside_m = 0.0;
  double border_returns = 1.0;  // Share of the pixels.
  double inside_returns = 1.0;
};

std::vector<DepthPoint> PointsSeenOf(const Facade& facade, uint64_t seed = 1) {
  const RandomStream stream(seed);
  std::vector<DepthPoint> points;
  uint64_t next = 0;
  for (int v = 1; v < 480; v += kEvery) {
    for (int u = 1; u < 640; u += kEvery) {
      const Vector3d ray_D = Depth().UnprojectRay({u, v}).value();
      const double outside =
          std::max(std::abs(2.0 * ray_D.x()) - 0.5, std::abs(2.0 * ray_D.y()) - 0.4);
      const bool is_inside = outside < -0.12;
      const bool is_border = outside < 0.0 && !is_inside;
      const double returns = is_inside   ? facade.inside_returns
                             : is_border ? facade.border_returns
                                         : 1.0;
      const double noise = stream.Normal(next);
      if (stream.Child("returns").Uniform(next++) >= returns) continue;
      const double behind_m = is_inside ? facade.inside_m : is_border ? facade.border_m : 0.0;
      points.push_back({.pixel = {u, v},
                        .ray_D = ray_D,
                        .inverse_depth = 1.0 / (2.0 + behind_m) + kSigma * noise,
                        .seen_px = {static_cast<float>(u), static_cast<float>(v)}});
    }
  }
  return points;
}

DepthPlane FirstGuess(const std::vector<DepthPoint>& points) {
  return FindDepthPlane(points, Settings().noise, 100, RandomStream(2)).value();
}

std::variant<FramePlanes, Miss> Measure(const Facade& facade,
                                        const FramePlaneSettings& settings = Settings(),
                                        const FrameRectangle& frame = Frame()) {
  const std::vector<DepthPoint> points = PointsSeenOf(facade);
  return MeasureFramePlanes(points, frame, FirstGuess(PointsSeenOf({})), Depth(), settings);
}

FramePlanes FoundPlanes(const std::variant<FramePlanes, Miss>& result) {
  const Miss* miss = std::get_if<Miss>(&result);
  EXPECT_EQ(miss, nullptr) << miss->reason << ": " << miss->detail;
  return miss == nullptr ? std::get<FramePlanes>(result) : FramePlanes{};
}

std::string ReasonOf(const std::variant<FramePlanes, Miss>& result) {
  const Miss* miss = std::get_if<Miss>(&result);
  return miss == nullptr ? "found" : miss->reason;
}

TEST(FramePlanes, OfAPaintedFrameAreTheWalls) {
  const FramePlanes planes = FoundPlanes(Measure({}));
  EXPECT_EQ(planes.setback_m, 0.0);
  EXPECT_EQ(planes.setback_sigma_m, 0.0);
  ASSERT_EQ(planes.planes.size(), 2u);
  for (const PlaneMeasurement& plane : planes.planes) {
    const Vector3d deviation = plane.information.inverse().diagonal().cwiseSqrt();
    EXPECT_LT(std::abs(plane.m.z() - 0.5), 4.0 * deviation.z());
    EXPECT_EQ(plane.relief_m, 0.0);
  }
  // What is within the frame is wall too, and makes it more certain.
  EXPECT_GT(planes.points.wall.size(), planes.points.border.size() + planes.points.inside.size());
}

TEST(FramePlanes, BlackPaintWithoutReturnsLeavesTheWallAlone) {
  const FramePlanes planes = FoundPlanes(Measure({.border_returns = 0.0}));
  ASSERT_EQ(planes.planes.size(), 1u);
  EXPECT_NEAR(planes.planes[0].m.z(), 0.5, 0.001);
}

TEST(FramePlanes, ASetbackThatIsSeenIsBelieved) {
  FramePlaneSettings settings = Settings();
  settings.setback_sigma_m = 0.05;
  const FramePlanes planes =
      FoundPlanes(Measure({.border_m = 0.08, .inside_m = 0.5}, settings, Frame(2.08)));
  EXPECT_NEAR(planes.setback_m, 0.08, 0.003);
  EXPECT_LT(planes.setback_sigma_m, 0.003);
  ASSERT_EQ(planes.planes.size(), 2u);
  EXPECT_NEAR(planes.planes[0].relief_m, planes.setback_m, 1e-12);
  EXPECT_EQ(planes.planes[1].relief_m, 0.0);
  EXPECT_NEAR(1.0 / planes.planes[1].m.norm(), 2.08, 0.003);
}

TEST(FramePlanes, WithFewReturnsTheirMeanIsTakenWithItsDoubt) {
  FramePlaneSettings settings = Settings();
  settings.setback_sigma_m = 0.05;
  const FramePlanes planes = FoundPlanes(
      Measure({.border_m = 0.08, .inside_m = 0.5, .border_returns = 0.45}, settings, Frame(2.08)));
  ASSERT_EQ(planes.planes.size(), 1u);
  EXPECT_NEAR(planes.setback_m, 0.08, 0.005);
  EXPECT_NEAR(planes.setback_sigma_m, 0.02, 0.003);
}

TEST(FramePlanes, WhereNothingReturnsTheFrameIsWhereTheSettingsSay) {
  FramePlaneSettings settings = Settings();
  settings.setback_m = 0.08;
  settings.setback_sigma_m = 0.01;
  const FramePlanes planes = FoundPlanes(Measure(
      {.border_m = 0.08, .border_returns = 0.1, .inside_returns = 0.0}, settings, Frame(2.08)));
  EXPECT_EQ(planes.setback_m, 0.08);
  EXPECT_EQ(planes.setback_sigma_m, 0.01);
  EXPECT_EQ(planes.planes.at(0).relief_m, 0.08);
}

// The wall's plane is as uncertain as the frame's setback, if that is for the fit to find.
TEST(FramePlanes, ASetbackThatTheFitFindsWidensTheWallsPlane) {
  FramePlaneSettings settings = Settings();
  settings.setback_m = 0.08;
  settings.setback_sigma_m = 0.03;
  const Facade facade{.border_m = 0.08, .border_returns = 0.0, .inside_returns = 0.0};
  const FramePlanes fixed = FoundPlanes(Measure(facade, settings, Frame(2.08)));
  settings.fits_setback = true;
  const FramePlanes fitted = FoundPlanes(Measure(facade, settings, Frame(2.08)));
  const auto deviation_m = [](const FramePlanes& planes) {
    const PlaneMeasurement& plane = planes.planes.at(0);
    return std::sqrt(plane.information.inverse()(2, 2)) / plane.m.squaredNorm();
  };
  EXPECT_LT(deviation_m(fixed), 0.003);
  EXPECT_NEAR(deviation_m(fitted), 0.03, 0.003);
}

TEST(FramePlanes, EveryMissSaysWhatIsSeen) {
  // A room behind what was taken for the border, as through the pane of a bright frame.
  EXPECT_EQ(ReasonOf(Measure({.border_m = 1.5, .inside_m = 1.5})), "open_border");
  // A monitor before the wall.
  EXPECT_EQ(ReasonOf(Measure({.border_m = -0.4, .inside_m = -0.4})), "stands_before");
  // A frame that does not stand where it was said to.
  EXPECT_EQ(ReasonOf(Measure({.border_m = 0.12, .inside_m = 0.5}, Settings(), Frame(2.12))),
            "unexpected_setback");
  FrameRectangle beside = Frame();
  beside.p_LO.x() = 40.0;
  EXPECT_EQ(ReasonOf(Measure({}, Settings(), beside)), "no_depth");
}

}  // namespace
}  // namespace fenestra
