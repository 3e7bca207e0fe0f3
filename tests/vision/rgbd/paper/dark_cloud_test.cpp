#include "vision/rgbd/paper/dark_cloud.h"

#include <gtest/gtest.h>

namespace fenestra {
namespace {

const CameraModel kTinyCamera = CameraModel::Pinhole(4, 3, 10.0);

RegisteredImages Bright() {
  return {cv::Mat3b(3, 4, cv::Vec3b(200, 200, 200)), cv::Mat1f(3, 4, 2.0f)};
}

TEST(SegmentDark, DemandsThatEveryChannelIsBelowTheThreshold) {
  RegisteredImages images = Bright();
  images.color(0, 0) = {49, 49, 49};
  images.color(0, 1) = {50, 0, 0};
  images.color(0, 2) = {0, 50, 0};
  images.color(0, 3) = {0, 0, 50};
  const DarkCloud cloud = SegmentDark(images, kTinyCamera, 50);
  EXPECT_EQ(cloud.dark_pixels, 1);
  EXPECT_EQ(cloud.mask(0, 0), 255);
}

TEST(SegmentDark, BackProjectsPixelsToMetres) {
  RegisteredImages images = Bright();
  images.color(2, 3) = {0, 0, 0};
  const DarkCloud cloud = SegmentDark(images, kTinyCamera, 50);
  ASSERT_EQ(cloud.points_K.size(), 1u);
  // (3 - 1.5) / 10 * 2 and (2 - 1) / 10 * 2.
  EXPECT_LT((cloud.points_K[0] - Eigen::Vector3d(0.3, 0.2, 2.0)).norm(), 1e-15);
  EXPECT_EQ(cloud.depth_m(2, 3), 2.0f);
  EXPECT_EQ(cv::countNonZero(cloud.depth_m), 1);
}

TEST(SegmentDark, CountsButLeavesOutPixelsWithoutDepth) {
  RegisteredImages images = Bright();
  images.color = cv::Vec3b(0, 0, 0);
  images.depth_m(1, 1) = 0.0f;
  const DarkCloud cloud = SegmentDark(images, kTinyCamera, 50);
  EXPECT_EQ(cloud.dark_pixels, 12);
  EXPECT_EQ(cloud.points_K.size(), 11u);
}

TEST(ConnectedParts, KeepsTheLargestConnectedPart) {
  RegisteredImages images = Bright();
  for (const cv::Point& p : {cv::Point(0, 0), cv::Point(1, 1), cv::Point(3, 0)}) {
    images.color(p) = {0, 0, 0};  // (0, 0) and (1, 1) touch at a corner; (3, 0) stands apart.
  }
  const DarkCloud largest =
      ConnectedParts(SegmentDark(images, kTinyCamera, 50), kTinyCamera, 1, 1).at(0);
  EXPECT_EQ(largest.points_K.size(), 2u);
  EXPECT_EQ(largest.depth_m(0, 3), 0.0f);
}

}  // namespace
}  // namespace fenestra
