#include "vision/detector_registry.h"

#include <functional>

#include "core/check.h"
#include "vision/rgbd/paper_rgbd.h"
#include "vision/rgbd/plane_rgbd.h"
#include "vision/stereo/edge_stereo.h"
#include "vision/stereo/paper_stereo.h"

namespace fenestra {
namespace {

using Factory =
    std::function<std::unique_ptr<Detector>(const SensorCalibration&, const OptionValues&)>;

struct Entry {
  DetectorInfo info;
  Factory make;
};

template <typename DetectorType, typename Calibration, typename Options>
Factory FactoryFor(const ParameterTable<Options>& table) {
  return [&table](const SensorCalibration& calibration, const OptionValues& values) {
    Options options;
    for (const auto& [name, value] : values) table.Set(options, name, value);
    return std::make_unique<DetectorType>(std::get<Calibration>(calibration), options);
  };
}

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries = {
      {{.name = "paper-stereo",
        .sensor = SensorKind::kStereo,
        .description = "Zhou et al. 2013, section 3: block matching, gap closing, Canny",
        .options = PaperStereoParameters().infos()},
       FactoryFor<PaperStereoDetector, StereoCalibration>(PaperStereoParameters())},
      {{.name = "edge-stereo",
        .sensor = SensorKind::kStereo,
        .description = "A dark frame's edges in both images, one rectangle fitted to all",
        .options = EdgeStereoParameters().infos()},
       FactoryFor<EdgeStereoDetector, StereoCalibration>(EdgeStereoParameters())},
      {{.name = "paper-rgbd",
        .sensor = SensorKind::kRgbd,
        .description = "Zhou et al. 2013, section 4: colour segmentation, NARF, diagonals",
        .options = PaperRgbdParameters().infos()},
       FactoryFor<PaperRgbdDetector, RgbdCalibration>(PaperRgbdParameters())},
      {{.name = "plane-rgbd",
        .sensor = SensorKind::kRgbd,
        .description = "A dark frame's edges in colour, the wall's plane in depth, one rectangle",
        .options = PlaneRgbdParameters().infos()},
       FactoryFor<PlaneRgbdDetector, RgbdCalibration>(PlaneRgbdParameters())},
  };
  return entries;
}

}  // namespace

const std::vector<DetectorInfo>& Detectors() {
  static const std::vector<DetectorInfo> infos = [] {
    std::vector<DetectorInfo> all;
    for (const Entry& entry : Entries()) all.push_back(entry.info);
    return all;
  }();
  return infos;
}

const DetectorInfo* FindDetector(const std::string& name) {
  for (const DetectorInfo& info : Detectors()) {
    if (info.name == name) return &info;
  }
  return nullptr;
}

std::unique_ptr<Detector> MakeDetector(const std::string& name,
                                       const SensorCalibration& calibration,
                                       const OptionValues& options) {
  for (const Entry& entry : Entries()) {
    if (entry.info.name == name) return entry.make(calibration, options);
  }
  FENESTRA_CHECK(false, "no detector named " + name);
}

}  // namespace fenestra
