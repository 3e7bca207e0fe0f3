#include "sim/camera/color_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "scenes/facade/facade.h"
#include "sim/motion/rig_pose.h"

namespace fenestra {
namespace {

// Bricks, mullions, a sill, glass and the room behind it, under sun and sky.
Scene BrickFacade() {
  FacadeOptions options{.window = {.setback_m = 0.1}};
  options.wall.finish = WallFinish::kBrick;
  options.wall.paint = {.reflectance = 0.3, .reflectance_830nm = 0.35};
  options.wall.texture_contrast = 0.2;
  options.sill.present = true;
  return MakeFacade(options);
}

Lighting Daylight() {
  Lighting lighting;
  lighting.sun = {.azimuth_rad = 0.6, .elevation_rad = 0.7, .illuminance_lx = 3e4};
  lighting.sky.illuminance_lx = 1e4;
  return lighting;
}

double RootMeanSquareOf(const cv::Mat& image) {
  return cv::norm(image.reshape(1), cv::NORM_L2) /
         std::sqrt(3.0 * static_cast<double>(image.total()));
}

TEST(ColorCameraTest, FewerRaysChangeLessThanAThirdOfTheNoise) {
  const RayCaster caster(BrickFacade());
  const auto see = [&](int samples, EdgeLines lines, int edge_samples, bool noise) {
    ColorCameraOptions options;
    options.samples_per_pixel = samples;
    options.edge_lines = lines;
    options.auto_exposure = false;
    options.exposure_s = 1e-4;
    options.sensor.noise = noise;
    const ColorCamera camera(options, DesignOf(options), Pose(), {}, edge_samples, RandomStream(0));
    cv::Mat3f image;
    camera
        .Observe(caster, Daylight(), RigPose({.distance_m = 2.0, .azimuth_rad = 0.2}, Pose()),
                 RandomStream(1))
        .convertTo(image, CV_32F);
    return image;
  };
  const cv::Mat3f exact = see(16, EdgeLines::kSixteen, 256, false);
  const double noise_dn = RootMeanSquareOf(see(16, EdgeLines::kSixteen, 256, true) - exact);
  const double error_dn = RootMeanSquareOf(see(1, EdgeLines::kFour, 64, false) - exact);
  RecordProperty("noise_dn", std::to_string(noise_dn));
  RecordProperty("error_dn", std::to_string(error_dn));
  EXPECT_GT(noise_dn, 1.5);
  // In quadrature a third adds 5 %.
  EXPECT_LT(error_dn, noise_dn / 3.0);
  // The twin: one ray everywhere and no search for edges is more than that.
  EXPECT_GT(RootMeanSquareOf(see(1, EdgeLines::kFour, 1, false) - exact), noise_dn / 3.0);
}

TEST(ColorCameraTest, ColoursThatAreBlurredAlikeAreGatheredAlike) {
  // A blur of 1.0001 times that of green takes the way of lenses with colour errors.
  const RayCaster caster(BrickFacade());
  const auto see = [&](double red_blur) {
    ColorCameraOptions options;
    options.red_blur = red_blur;
    options.sensor.noise = false;
    return ColorCamera(options, DesignOf(options), Pose(), {}, 64, RandomStream(0))
        .Observe(caster, Daylight(), RigPose({.distance_m = 2.0}, Pose()), RandomStream(1));
  };
  const cv::Mat3b plain = see(1.0);
  const auto differing = [&](double red_blur) {
    cv::Mat3b difference;
    cv::absdiff(plain, see(red_blur), difference);
    double most = 0.0;
    cv::minMaxLoc(difference.reshape(1), nullptr, &most);
    const double share =
        cv::countNonZero(difference.reshape(1)) / (3.0 * static_cast<double>(plain.total()));
    return std::pair(most, share);
  };
  // Here and there a value is rounded to the next of the sensor's ten bits, which in the dark are
  // 12.92 · 255/1023 = 3.2 codes apart.
  const auto [most, share] = differing(1.0001);
  EXPECT_LE(most, 4.0);
  EXPECT_LT(share, 1e-3);
  // The twin: a tenth more of blur is seen.
  EXPECT_GT(differing(1.1).second, 0.02);
}

}  // namespace
}  // namespace fenestra
