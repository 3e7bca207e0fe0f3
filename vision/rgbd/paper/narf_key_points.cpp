#include "vision/rgbd/paper/narf_key_points.h"

#include <pcl/features/range_image_border_extractor.h>
#include <pcl/keypoints/narf_keypoint.h>
#include <pcl/range_image/range_image_planar.h>

#include <algorithm>

#include "core/system/check.h"

namespace fenestra {

struct NarfRangeImage::Impl {
  pcl::RangeImagePlanar range_image;
};

namespace {

// PCL fills its static trigonometric tables without a lock when the first range image is made.
// Making one here allows detectors to run in several threads.
void FillLookupTables() {
  static const pcl::RangeImage first;
  static_cast<void>(first);
}

// Pixel (n u, n v) becomes (u, v), so the principal point and the focal lengths are divided by n.
cv::Mat1f EveryNth(const cv::Mat1f& image, int n) {
  cv::Mat1f thinned(std::max(1, image.rows / n), std::max(1, image.cols / n));
  for (int v = 0; v < thinned.rows; ++v) {
    for (int u = 0; u < thinned.cols; ++u) thinned(v, u) = image(n * v, n * u);
  }
  return thinned;
}

}  // namespace

bool NarfRangeImage::Supports(const CameraModel& camera) {
  return !camera.has_distortion() && 0.5 * camera.width_px() < camera.parameters().fx_px;
}

NarfRangeImage::NarfRangeImage(const cv::Mat1f& depth_m, const CameraModel& camera, int stride,
                               bool unseen_is_far)
    : stride_(stride) {
  FENESTRA_CHECK(Supports(camera), "no planar range image for this camera");
  FENESTRA_CHECK(stride >= 1, "a stride is at least 1");
  FENESTRA_CHECK(depth_m.cols == camera.width_px() && depth_m.rows == camera.height_px(),
                 "the depth image is not the camera's");
  FillLookupTables();
  auto impl = std::make_unique<Impl>();
  const CameraParameters& p = camera.parameters();
  const cv::Mat1f thinned = EveryNth(depth_m, stride);
  impl->range_image.setDepthImage(
      thinned.ptr<float>(), thinned.cols, thinned.rows, static_cast<float>(p.cx_px / stride),
      static_cast<float>(p.cy_px / stride), static_cast<float>(p.fx_px / stride),
      static_cast<float>(p.fy_px / stride));
  if (unseen_is_far) impl->range_image.setUnseenToMaxRange();
  impl_ = std::move(impl);
}

NarfRangeImage::~NarfRangeImage() = default;

std::vector<KeyPoint> NarfRangeImage::DetectKeyPoints(const NarfSettings& settings) const {
  FENESTRA_CHECK(settings.support_size_m > 0.0, "NARF needs a support size");
  const pcl::RangeImagePlanar& image = impl_->range_image;
  pcl::RangeImageBorderExtractor borders;
  borders.getParameters().max_no_of_threads = 1;
  pcl::NarfKeypoint narf(&borders);
  narf.setRangeImage(&image);
  narf.getParameters().support_size = static_cast<float>(settings.support_size_m);
  narf.getParameters().min_interest_value = static_cast<float>(settings.min_interest_value);
  narf.getParameters().max_no_of_threads = 1;
  pcl::PointCloud<int> indices;
  narf.compute(indices);

  const int width = static_cast<int>(image.width);
  std::vector<KeyPoint> key_points;
  for (const int index : indices.points) {
    const pcl::PointWithRange& point = image.getPoint(index);
    key_points.push_back({.pixel = {stride_ * (index % width), stride_ * (index / width)},
                          .p_KQ = point.getVector3fMap().cast<double>()});
  }
  return key_points;
}

}  // namespace fenestra
