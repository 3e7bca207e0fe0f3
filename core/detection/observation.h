#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string_view>
#include <variant>

namespace fenestra {

/// Two grey images taken at one instant, as the sensors deliver them: distorted, unrectified.
struct StereoObservation {
  cv::Mat1b left;
  cv::Mat1b right;
};

/// Depth along the optical axis: z [m] = raw · unit_m; 0 means no return.
struct DepthImage {
  cv::Mat1w raw;
  double unit_m = 0.001;
};

/// A colour image (8 bit, channels in OpenCV's order B, G, R; sRGB-encoded) and a depth image.
/// The calibration says which camera the depth pixels belong to.
struct RgbdObservation {
  cv::Mat3b color;
  DepthImage depth;
};

/// All that a detector sees of the world.
using Observation = std::variant<StereoObservation, RgbdObservation>;

enum class SensorKind { kStereo, kRgbd };

/// "stereo" or "rgbd".
const char* ToString(SensorKind kind);
/// The kind of that name, or nullopt for any other word.
std::optional<SensorKind> ParseSensorKind(std::string_view word);

}  // namespace fenestra
