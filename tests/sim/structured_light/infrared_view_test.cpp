#include "sim/structured_light/infrared_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"

namespace fenestra {
namespace {

constexpr double kBaseline_m = 0.075;
const Eigen::Vector3d kProjector(kBaseline_m, 0.0, 0.0);

// A wall with a frame on it, and a plate half a metre before both.
Scene PlateBeforeTarget() {
  Scene scene = MakePaperTarget({});
  scene.meshes.push_back({.name = "plate",
                          .positions_W = {{-0.2f, -0.3f, 0.5f},
                                          {0.3f, -0.3f, 0.5f},
                                          {0.3f, 0.2f, 0.5f},
                                          {-0.2f, 0.2f, 0.5f}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}},
                          .material = scene.meshes.front().material});
  return scene;
}

TEST(InfraredViewTest, PartsSeeWhatRaysThroughTheirPlacesHit) {
  const RayCaster caster(PlateBeforeTarget());
  const CameraModel camera = CameraModel::Pinhole(320, 240, 285.63);
  const Pose X_WC = RigPose({.distance_m = 2.0, .azimuth_rad = 0.3, .elevation_rad = 0.1}, Pose());
  const InfraredView view = InfraredRays(camera).Cast(caster, X_WC, {}, kProjector);
  ASSERT_FALSE(view.parts.empty());
  for (int part = 0; part < PixelParts::kPerPixel; ++part) {
    const Eigen::Vector2d offset = PixelParts::OffsetOf(part);
    const cv::Vec2f offset_px(static_cast<float>(offset.x()), static_cast<float>(offset.y()));
    const AovImages whole =
        caster.CastAovs(RayGrid(camera), X_WC, {},
                        {.offsets_px = cv::Mat2f(240, 320, offset_px), .p_WP = X_WC * kProjector});
    int differing = 0;
    int count = 0;
    for (const PixelParts& parts : view.parts) {
      for (size_t i = 0; i < parts.pixels.size(); ++i, ++count) {
        const cv::Point place = parts.PlaceOf(i, part);
        const float z_m = parts.aovs.depth_m(place);
        // Rays are single precision: one at an outline may fall on its other side.
        const bool same = std::abs(z_m - whole.depth_m(parts.pixels[i])) < 1e-4f * z_m &&
                          parts.aovs.sees_point(place) == whole.sees_point(parts.pixels[i]);
        if (!same) ++differing;
      }
    }
    EXPECT_LE(differing, count / 500) << part;
  }
}

TEST(InfraredViewTest, PartsAreSpreadOverThePixel) {
  Eigen::Vector2d sum(0.0, 0.0);
  for (int part = 0; part < PixelParts::kPerPixel; ++part) {
    const Eigen::Vector2d offset = PixelParts::OffsetOf(part);
    EXPECT_LT(offset.cwiseAbs().maxCoeff(), 0.5);
    for (int other = 0; other < part; ++other) {
      EXPECT_GT((offset - PixelParts::OffsetOf(other)).cwiseAbs().minCoeff(), 0.12);
    }
    sum += offset;
  }
  EXPECT_NEAR(sum.norm(), 0.0, 1e-12);
}

TEST(InfraredViewTest, OutlinesAndShadowsCrossPixelsAndATiltedWallDoesNot) {
  const CameraModel camera = CameraModel::Pinhole(320, 240, 285.63);
  const RayGrid rays(camera);
  PaperTargetOptions blank;
  blank.with_target = false;
  // 45°: disparity changes by b/z tan 45° = 0.04 px from pixel to pixel.
  const Pose X_WC = RigPose({.distance_m = 2.0, .azimuth_rad = 0.785}, Pose());
  const AovOptions options{.offsets_px = {}, .p_WP = X_WC * kProjector};
  const double fb = 285.63 * kBaseline_m;
  const AovImages wall = RayCaster(MakePaperTarget(blank)).CastAovs(rays, X_WC, {}, options);
  ASSERT_EQ(cv::countNonZero(wall.object_id >= 0), 320 * 240);
  EXPECT_TRUE(CrossedPixels(wall, fb).empty());
  const Pose X_WF = RigPose({.distance_m = 2.0}, Pose());
  const AovImages plate =
      RayCaster(PlateBeforeTarget())
          .CastAovs(rays, X_WF, {}, {.offsets_px = {}, .p_WP = X_WF * kProjector});
  // The row through the plate's middle: both of its sides are at pixels of their own.
  const std::vector<cv::Point> crossed = CrossedPixels(plate, fb);
  const auto crosses = [&](double x_m, double z_m) {
    const double u = 159.5 + 285.63 * x_m / z_m;
    return std::any_of(crossed.begin(), crossed.end(),
                       [u](cv::Point p) { return p.y == 120 && std::abs(p.x - u) <= 0.5; });
  };
  EXPECT_TRUE(crosses(-0.2, 1.5));
  EXPECT_TRUE(crosses(0.3, 1.5));
  EXPECT_FALSE(crosses(0.05, 1.5));
}

}  // namespace
}  // namespace fenestra
