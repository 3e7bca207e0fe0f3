#include "vision/rgbd/plane/plane_pictures.h"

#include "vision/rgbd/rgbd_images.h"

namespace fenestra {

cv::Mat3b DrawDepthUse(const DepthImage& depth, const FramePlanes& planes,
                       const DepthPointReader& reader) {
  cv::Mat1f depth_m;
  depth.raw.convertTo(depth_m, CV_32F, depth.unit_m);
  cv::Mat3b picture;
  DrawDepth(depth_m).convertTo(picture, CV_8U, 0.4);
  const auto mark = [&](const DepthPoint& point, const cv::Vec3b& colour) {
    const cv::Rect place =
        cv::Rect(point.pixel.x - reader.columns() / 2, point.pixel.y - reader.rows() / 2,
                 reader.columns(), reader.rows()) &
        cv::Rect({0, 0}, picture.size());
    picture(place).setTo(colour);
  };
  for (size_t i = 0; i < planes.points.wall.size(); ++i) {
    mark(planes.points.wall[i],
         planes.wall.is_inlier[i] ? cv::Vec3b(80, 200, 80) : cv::Vec3b(60, 60, 230));
  }
  for (const DepthPoint& point : planes.points.border) mark(point, {60, 220, 230});
  return picture;
}

}  // namespace fenestra
