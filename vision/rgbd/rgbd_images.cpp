#include "vision/rgbd/rgbd_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/geometry/calibration_entries.h"
#include "core/io/faults.h"
#include "core/io/input_error.h"
#include "core/io/srgb.h"

namespace fenestra {
namespace {

std::string SizeText(const cv::Size& size) {
  return fmt::format("{} x {} px", size.width, size.height);
}

cv::Size SizeOf(const CameraModel& camera) {
  return {camera.width_px(), camera.height_px()};
}

// A pixel outside the image where the lens sees nothing, so that it becomes black there.
constexpr float kOutside = -1e4f;

constexpr double kBright_dn = 200.0;
constexpr double kBrightShare = 0.98;
constexpr int kUnits = 5461;  // Largest value of a channel; the sum of three fills 14 bits.
constexpr int kSums = 3 * kUnits + 1;

std::array<int, 256> MakeTable() {
  std::array<int, 256> table{};
  for (size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<int>(std::lround(kUnits * LinearFromSrgb(static_cast<double>(i) / 255)));
  }
  return table;
}

}  // namespace

const RgbdObservation& RgbdPart(const Observation& observation) {
  const auto* rgbd = std::get_if<RgbdObservation>(&observation);
  if (rgbd == nullptr) {
    throw InputError("observation", "a stereo observation was given to an RGB-D detector");
  }
  return *rgbd;
}

void CheckDepthUnit(const RgbdCalibration& calibration) {
  if (const auto objection = DepthUnitObjection(calibration.depth_unit_m)) {
    throw InputError("depth_unit_m", *objection);
  }
}

void CheckFits(const RgbdObservation& observation, const RgbdCalibration& calibration) {
  Faults faults;
  const auto require = [&faults](const char* image, bool holds, std::string message) {
    if (!holds) faults.AddFault({.source = image, .message = std::move(message)});
  };
  const auto require_size = [&require](const char* image, const cv::Size& found,
                                       const cv::Size& want) {
    require(image, found == want,
            fmt::format("the image has {}, its calibration {}", SizeText(found), SizeText(want)));
  };
  require_size("color", observation.color.size(), SizeOf(calibration.color));
  require_size("depth", observation.depth.raw.size(), SizeOf(calibration.depth));
  require("depth", observation.depth.unit_m == calibration.depth_unit_m,
          fmt::format("the image has a unit of {} m, its calibration {} m",
                      observation.depth.unit_m, calibration.depth_unit_m));
  faults.ThrowIfAny();
}

CameraModel WithoutDistortion(const CameraModel& camera) {
  CameraParameters parameters = camera.parameters();
  parameters.distortion = {};
  return CameraModel(parameters);
}

cv::Mat2f UndistortionMap(const CameraModel& camera) {
  const CameraModel pinhole = WithoutDistortion(camera);
  cv::Mat2f map(camera.height_px(), camera.width_px(), cv::Vec2f(kOutside, kOutside));
  for (int v = 0; v < map.rows; ++v) {
    for (int u = 0; u < map.cols; ++u) {
      const auto ray = pinhole.UnprojectRay({u, v});
      const auto pixel = ray ? camera.Project(*ray) : std::nullopt;
      if (pixel) map(v, u) = {static_cast<float>(pixel->x()), static_cast<float>(pixel->y())};
    }
  }
  return map;
}

cv::Mat3b DrawDepth(const cv::Mat1f& depth_m) {
  const cv::Mat1b seen = depth_m > 0.0f;
  cv::Mat3b drawn = cv::Mat3b::zeros(depth_m.size());
  if (cv::countNonZero(seen) == 0) return drawn;
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  cv::minMaxLoc(depth_m, &nearest_m, &farthest_m, nullptr, nullptr, seen);
  const double scale = -255.0 / std::max(farthest_m - nearest_m, 1e-3);
  cv::Mat1b nearness;
  depth_m.convertTo(nearness, CV_8U, scale, 255.0 - scale * nearest_m);
  cv::Mat3b colors;
  cv::applyColorMap(nearness, colors, cv::COLORMAP_TURBO);
  colors.copyTo(drawn, seen);
  return drawn;
}

cv::Mat1b LinearGrey(const cv::Mat3b& color) {
  static const std::array<int, 256> linear = MakeTable();
  if (color.empty()) return {};
  cv::Mat1w sums(color.size());
  std::vector<int> counts(kSums, 0);
  for (int v = 0; v < color.rows; ++v) {
    const cv::Vec3b* row = color.ptr<cv::Vec3b>(v);
    ushort* out = sums.ptr<ushort>(v);
    for (int u = 0; u < color.cols; ++u) {
      const int sum = linear[row[u][0]] + linear[row[u][1]] + linear[row[u][2]];
      out[u] = static_cast<ushort>(sum);
      ++counts[static_cast<size_t>(sum)];
    }
  }
  const double wanted = kBrightShare * static_cast<double>(color.total());
  int bright = 0;
  for (double below = counts[0]; below < wanted && bright + 1 < kSums;) {
    below += counts[static_cast<size_t>(++bright)];
  }
  const double unclipped = kBright_dn / std::max(1, bright);
  cv::Mat1b grey;
  sums.convertTo(grey, CV_8U, std::max(255.0 / (kSums - 1), unclipped));
  return grey;
}

}  // namespace fenestra
