#include "vision/stereo/rectification.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/io/input_error.h"
#include "tests/vision/stereo/stereo_scene.h"

namespace fenestra {
namespace {

using testing::PaperRig;

constexpr BrownConrady kBarrel{.k1 = -0.1, .k2 = 0.01, .p1 = 1e-4, .p2 = -1e-4, .k3 = 0.0};

// A soft dot at a sub-pixel position.
cv::Mat1b Dot(const Eigen::Vector2d& centre) {
  cv::Mat1b image(480, 752, uint8_t{0});
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const double r2 = (Eigen::Vector2d(u, v) - centre).squaredNorm();
      image(v, u) = cv::saturate_cast<uint8_t>(250.0 * std::exp(-r2 / 32.0));
    }
  }
  return image;
}

Eigen::Vector2d CentreOfMass(const cv::Mat1b& image) {
  const cv::Moments m = cv::moments(image);
  return {m.m10 / m.m00, m.m01 / m.m00};
}

TEST(Rectification, DotsLandOnOneRowWithDisparityFBOverZ) {
  const StereoCalibration rig = PaperRig(kBarrel, {0.01, 0.0175, -0.012});
  const StereoRectification rectification(rig, 1.0);
  const RectifiedCamera& camera = rectification.camera();
  EXPECT_NEAR(camera.baseline_m, 0.35, 1e-12);
  const Eigen::Vector3d points_L[] = {
      {0.2, 0.0, 3.0}, {-0.7, 0.6, 3.0}, {1.1, -0.7, 3.5}, {0.4, 0.3, 1.5}};
  for (const Eigen::Vector3d& p_LQ : points_L) {
    const auto left = rig.left.Project(p_LQ);
    const auto right = rig.right.Project(rig.X_RL * p_LQ);
    ASSERT_TRUE(left && right);
    const RectifiedPair pair = rectification.Rectify({Dot(*left), Dot(*right)});
    const Eigen::Vector3d p_FQ = rectification.R_LF().transpose() * p_LQ;
    const Eigen::Vector2d expected(camera.f_px * p_FQ.x() / p_FQ.z() + camera.cx_px,
                                   camera.f_px * p_FQ.y() / p_FQ.z() + camera.cy_px);
    const double d_px = camera.DisparityFromDepth(p_FQ.z());
    // cv::remap interpolates at 1/32 px; the dot's mean is also drawn by the change of scale
    // across it, some 1e-2 px.
    EXPECT_LT((CentreOfMass(pair.left) - expected).norm(), 0.05);
    EXPECT_LT((CentreOfMass(pair.right) - expected + Eigen::Vector2d(d_px, 0.0)).norm(), 0.05);
  }
}

TEST(Rectification, AlphaOneKeepsWhatTheSensorSaw) {
  const StereoCalibration rig = PaperRig(kBarrel);
  const StereoRectification rectification(rig, 1.0);
  const RectifiedCamera& camera = rectification.camera();
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(0, 0), Eigen::Vector2d(751, 0),
                                       Eigen::Vector2d(751, 479), Eigen::Vector2d(0, 479)}) {
    const auto ray_L = rig.left.UnprojectRay(pixel);
    ASSERT_TRUE(ray_L);
    const Eigen::Vector3d ray_F = rectification.R_LF().transpose() * *ray_L;
    const double u = camera.f_px * ray_F.x() / ray_F.z() + camera.cx_px;
    const double v = camera.f_px * ray_F.y() / ray_F.z() + camera.cy_px;
    EXPECT_TRUE(u > -1.0 && u < 752.0 && v > -1.0 && v < 480.0) << u << ' ' << v;
  }
}

TEST(Rectification, RefusesWhatIsNoStereoPair) {
  const StereoCalibration good = PaperRig();
  const auto refused = [](const StereoCalibration& rig) {
    EXPECT_THROW(StereoRectification(rig, 1.0), InputError);
  };
  refused({good.right, good.left, good.X_RL.inverse()});
  refused({good.left, good.right, Pose()});
  refused({good.left, good.right, Pose::Translation({-0.1, -0.3, 0.0})});
  refused({good.left, good.right.Scaled(0.5), good.X_RL});
  const CameraModel tiny = CameraModel::Pinhole(1, 1, 1.0);
  refused({tiny, tiny, good.X_RL});
}

TEST(Rectification, RefusesImagesOfOtherSizes) {
  const StereoRectification rectification(PaperRig(), 1.0);
  const cv::Mat1b good(480, 752, uint8_t{9});
  EXPECT_NO_THROW(rectification.Rectify({good, good}));
  EXPECT_THROW(rectification.Rectify({good, cv::Mat1b(1, 1, uint8_t{9})}), InputError);
  EXPECT_THROW(rectification.Rectify({cv::Mat1b(), good}), InputError);
}

}  // namespace
}  // namespace fenestra
