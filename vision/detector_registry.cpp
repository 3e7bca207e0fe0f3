#include "vision/detector_registry.h"

#include "core/io/input_error.h"
#include "core/system/check.h"
#include "vision/rgbd/paper/paper_rgbd.h"
#include "vision/rgbd/plane/plane_rgbd.h"
#include "vision/stereo/edge/edge_stereo.h"
#include "vision/stereo/paper/paper_stereo.h"

namespace fenestra {
namespace {

struct Entry {
  DetectorInfo info;
  DetectorFactory make;
};

std::vector<Entry> BuiltIn() {
  return {
      {{.name = "paper-stereo",
        .sensor = SensorKind::kStereo,
        .description = "Zhou et al. 2013, section 3: block matching, gap closing, Canny",
        .options = PaperStereoParameters().infos()},
       FactoryFor<PaperStereoDetector, StereoCalibration>(PaperStereoParameters())},
      {{.name = "edge-stereo",
        .sensor = SensorKind::kStereo,
        .description = "A dark frame's edges in both images, with one rectangle fitted to all",
        .options = EdgeStereoParameters().infos()},
       FactoryFor<EdgeStereoDetector, StereoCalibration>(EdgeStereoParameters())},
      {{.name = "paper-rgbd",
        .sensor = SensorKind::kRgbd,
        .description = "Zhou et al. 2013, section 4: colour segmentation, NARF, diagonals",
        .options = PaperRgbdParameters().infos()},
       FactoryFor<PaperRgbdDetector, RgbdCalibration>(PaperRgbdParameters())},
      {{.name = "plane-rgbd",
        .sensor = SensorKind::kRgbd,
        .description = "A dark frame's edges in colour and the wall's plane in depth, with one "
                       "rectangle fitted",
        .options = PlaneRgbdParameters().infos()},
       FactoryFor<PlaneRgbdDetector, RgbdCalibration>(PlaneRgbdParameters())},
  };
}

struct Registry {
  std::vector<Entry> entries = BuiltIn();
  std::vector<DetectorInfo> infos;

  Registry() {
    for (const Entry& entry : entries) infos.push_back(entry.info);
  }
};

// The registry is the only global state here; detectors stay registered.
Registry& TheRegistry() {
  static Registry registry;
  return registry;
}

}  // namespace

const std::vector<DetectorInfo>& Detectors() {
  return TheRegistry().infos;
}

bool IsDetectorName(const std::string& name) {
  return !name.empty() && name.size() <= 64 &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string::npos;
}

void RegisterDetector(const DetectorInfo& info, const DetectorFactory& make) {
  if (!IsDetectorName(info.name)) {
    throw InputError(info.name, "is no name of a detector: 1 to 64 of the characters a-z 0-9 _ -");
  }
  if (FindDetector(info.name) != nullptr) {
    throw InputError(info.name, "there is a detector of that name already");
  }
  TheRegistry().entries.push_back({info, make});
  TheRegistry().infos.push_back(info);
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
  for (const Entry& entry : TheRegistry().entries) {
    if (entry.info.name == name) return entry.make(calibration, options);
  }
  FENESTRA_CHECK(false, "no detector named " + name);
}

}  // namespace fenestra
