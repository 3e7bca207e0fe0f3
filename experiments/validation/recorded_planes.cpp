#include "experiments/validation/recorded_planes.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/io/image_io.h"

namespace fenestra::validation {
namespace {

constexpr double kStepOfKinect = 2.92e-3;
constexpr double kStepOfTum = 2.71e-3;  // The benchmark scales its depths.

RecordedPlane Pcl(const std::string& frame, const std::string& what,
                  std::vector<cv::Point> polygon) {
  return {frame + " " + what,
          "depth-pcl/" + frame + "-depth.png",
          "PointCloudLibrary, BSD-3",
          1e-3,
          525.0,
          {319.5, 239.5},
          kStepOfKinect,
          std::move(polygon)};
}

RecordedPlane Tum(const std::string& what, std::vector<cv::Point> polygon) {
  return {"freiburg2 " + what,
          "rgbd-tum/second_depth.png",
          "TUM RGB-D, CC BY 4.0",
          2e-4,
          520.9,
          {325.1, 249.7},
          kStepOfTum,
          std::move(polygon)};
}

}  // namespace

const std::vector<RecordedPlane>& RecordedPlanes() {
  static const std::vector<RecordedPlane> planes = {
      Pcl("person", "wall", {{40, 40}, {440, 40}, {430, 140}, {170, 150}, {150, 270}, {40, 300}}),
      Pcl("person", "cupboard", {{372, 195}, {475, 195}, {475, 425}, {372, 425}}),
      Pcl("capture0003", "wall", {{370, 40}, {590, 40}, {590, 185}, {370, 185}}),
      Pcl("capture0005", "wall", {{510, 40}, {590, 40}, {590, 175}, {510, 175}}),
      Pcl("five_people", "back wall", {{230, 85}, {460, 85}, {460, 98}, {230, 98}}),
      Pcl("five_people", "floor", {{285, 345}, {330, 345}, {330, 470}, {290, 470}}),
      Pcl("region_growing_rgb", "near floor",
          {{20, 470},
           {590, 470},
           {590, 200},
           {560, 140},
           {470, 120},
           {445, 290},
           {300, 290},
           {300, 200},
           {20, 260}}),
      Pcl("region_growing_rgb", "far floor",
          {{325, 60}, {590, 60}, {590, 140}, {470, 120}, {330, 110}}),
      Tum("floor", {{458, 150}, {600, 160}, {610, 360}, {555, 255}, {455, 220}}),
      Tum("floor beyond", {{458, 118}, {600, 128}, {600, 160}, {458, 150}}),
      Tum("screen", {{228, 120}, {360, 120}, {360, 225}, {228, 225}})};
  return planes;
}

DepthView ViewOf(const RecordedPlane& recorded, const std::filesystem::path& recordings) {
  const cv::Mat1w raw = ReadDepthImage(recordings / recorded.file);
  DepthView view{cv::Mat1d(), recorded.focal_px, recorded.centre_px};
  raw.convertTo(view.z_m, CV_64F, recorded.unit_m);
  return view;
}

cv::Mat1b MaskIn(const RecordedPlane& recorded, const DepthView& view) {
  std::vector<cv::Point> polygon;
  for (const cv::Point& p : recorded.polygon) {
    const Eigen::Vector2d ray =
        (Eigen::Vector2d(p.x, p.y) - recorded.centre_px) / recorded.focal_px;
    const Eigen::Vector2d pixel = view.centre_px + view.focal_px * ray;
    polygon.emplace_back(static_cast<int>(std::lround(pixel.x())),
                         static_cast<int>(std::lround(pixel.y())));
  }
  cv::Mat1b mask = cv::Mat1b::zeros(view.z_m.size());
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{polygon}, 255);
  // Blocks of pixels beyond leave the image; of registered ones elsewhere than of others.
  constexpr int kBorder_px = 8;
  cv::rectangle(mask, {0, 0}, {mask.cols - 1, mask.rows - 1}, 0, 2 * kBorder_px);
  return mask;
}

}  // namespace fenestra::validation
