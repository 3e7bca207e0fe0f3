#include "core/detection/observation.h"

#include <fmt/format.h>

#include <vector>

#include "core/io/faults.h"
#include "core/io/image_io.h"
#include "core/io/temporary_files.h"

namespace fenestra {
namespace {

/// An image file, what it shows, and the camera that its calibration says took it.
struct ImageOf {
  const std::filesystem::path& file;
  cv::Size size;
  const CameraModel& camera;
};

// Throws InputError with all faults.
void CheckSizes(const std::vector<ImageOf>& images) {
  Faults faults;
  for (const auto& [file, size, camera] : images) {
    if (size == cv::Size(camera.width_px(), camera.height_px())) continue;
    faults.AddFault(
        {.source = file.string(),
         .message = fmt::format("is {} x {} px; the calibration is for {} x {} px", size.width,
                                size.height, camera.width_px(), camera.height_px())});
  }
  faults.ThrowIfAny();
}

}  // namespace

const char* ToString(SensorKind kind) {
  return kind == SensorKind::kStereo ? "stereo" : "rgbd";
}

std::optional<SensorKind> ParseSensorKind(std::string_view word) {
  for (const SensorKind kind : {SensorKind::kStereo, SensorKind::kRgbd}) {
    if (word == ToString(kind)) return kind;
  }
  return std::nullopt;
}

ObservationFiles ObservationFiles::In(const std::filesystem::path& folder, SensorKind sensor) {
  ObservationFiles files;
  files.sensor = sensor;
  files.calibration = folder / "calibration.yaml";
  if (sensor == SensorKind::kStereo) {
    files.left = folder / "left.png";
    files.right = folder / "right.png";
  } else {
    files.color = folder / "color.png";
    files.depth = folder / "depth.png";
  }
  return files;
}

void WriteObservation(const OutputPath& folder, const Observation& observation,
                      const SensorCalibration& calibration) {
  if (const auto* stereo = std::get_if<StereoObservation>(&observation)) {
    const auto files = ObservationFiles::In({}, SensorKind::kStereo);
    WritePng(folder / files.left, stereo->left);
    WritePng(folder / files.right, stereo->right);
    WriteFileAtomically(folder / files.calibration,
                        ToOpenCvYaml(std::get<StereoCalibration>(calibration)));
  } else {
    const auto files = ObservationFiles::In({}, SensorKind::kRgbd);
    const auto& rgbd = std::get<RgbdObservation>(observation);
    WritePng(folder / files.color, rgbd.color);
    WritePng(folder / files.depth, rgbd.depth.raw);
    WriteFileAtomically(folder / files.calibration,
                        ToOpenCvYaml(std::get<RgbdCalibration>(calibration)));
  }
}

RecordedObservation ReadObservation(const ObservationFiles& files) {
  if (files.sensor == SensorKind::kStereo) {
    const StereoCalibration cameras = ReadStereoCalibration(files.calibration);
    const StereoObservation images{ReadGrayImage(files.left), ReadGrayImage(files.right)};
    CheckSizes({{files.left, images.left.size(), cameras.left},
                {files.right, images.right.size(), cameras.right}});
    return {.observation = images, .calibration = cameras};
  }
  const RgbdCalibration cameras = ReadRgbdCalibration(files.calibration);
  const RgbdObservation images{ReadColorImage(files.color),
                               {ReadDepthImage(files.depth), cameras.depth_unit_m}};
  CheckSizes({{files.color, images.color.size(), cameras.color},
              {files.depth, images.depth.raw.size(), cameras.depth}});
  return {.observation = images, .calibration = cameras};
}

}  // namespace fenestra
