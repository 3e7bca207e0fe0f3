#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>
#include <variant>

#include "core/geometry/calibration.h"
#include "core/io/output_path.h"

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

/// Where one observation and its calibration are, a file each:
///
///     left.png, right.png, calibration.yaml      (stereo; 8-bit grey)
///     color.png, depth.png, calibration.yaml     (RGB-D; 8-bit colour, 16-bit depth, 0: no return)
struct ObservationFiles {
  SensorKind sensor = SensorKind::kStereo;
  std::filesystem::path left, right;   ///< Stereo.
  std::filesystem::path color, depth;  ///< RGB-D.
  std::filesystem::path calibration;

  /// With the names above.
  static ObservationFiles In(const std::filesystem::path& folder, SensorKind sensor);
};

/// Writes an observation and its calibration alone, without loss, under the names above.
void WriteObservation(const OutputPath& folder, const Observation& observation,
                      const SensorCalibration& calibration);

struct RecordedObservation {
  Observation observation;
  SensorCalibration calibration;
};

/// Throws InputError for a file that is missing, damaged or of another kind, and for images whose
/// sizes are not those of the calibration.
RecordedObservation ReadObservation(const ObservationFiles& files);

}  // namespace fenestra
