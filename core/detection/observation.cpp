#include "core/detection/observation.h"

#include "core/io/image_io.h"
#include "core/io/temporary_files.h"

namespace fenestra {

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
    return {.observation = StereoObservation{ReadGrayImage(files.left), ReadGrayImage(files.right)},
            .calibration = ReadStereoCalibration(files.calibration)};
  }
  const RgbdCalibration calibration = ReadRgbdCalibration(files.calibration);
  return {.observation = RgbdObservation{ReadColorImage(files.color),
                                         {ReadDepthImage(files.depth), calibration.depth_unit_m}},
          .calibration = calibration};
}

}  // namespace fenestra
