#include <fmt/format.h>

#include <filesystem>

#include "core/detection/detection_json.h"
#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/geometry/calibration_entries.h"
#include "core/io/input_error.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/trial_files/trial_files.h"

namespace fenestra::cli {
namespace {

struct DetectArguments {
  DetectorArguments detector;
  std::filesystem::path calibration;
  std::filesystem::path left, right;   ///< Stereo.
  std::filesystem::path color, depth;  ///< RGB-D.
  double depth_scale = 0.0;            ///< Units per metre; 0: as the calibration says.
  bool json = false;
  std::filesystem::path pictures;
};

void Detect(const DetectArguments& arguments, const Observation& observation,
            const SensorCalibration& calibration, SensorKind sensor) {
  const DetectorChoice choice = ChooseDetector(arguments.detector, sensor);
  const auto detector = MakerWith(arguments.detector.plugins)->Make(choice, calibration);
  StageLog log(SteadyClock(), !arguments.pictures.empty());
  const Detection detection = detector->Detect(observation, log);
  log.End();
  if (!arguments.pictures.empty()) {
    WritePictures(OutputPath::Folder(arguments.pictures), observation, calibration, nullptr,
                  std::get_if<WindowEstimate>(&detection), log);
  }
  fmt::print("{}", arguments.json ? DetectionJson(choice.label, detection, log)
                                  : DetectionText(choice.label, detection, log));
}

void DetectStereo(const DetectArguments& arguments) {
  const auto [observation, calibration] = ReadObservation({.sensor = SensorKind::kStereo,
                                                           .left = arguments.left,
                                                           .right = arguments.right,
                                                           .color = {},
                                                           .depth = {},
                                                           .calibration = arguments.calibration});
  Detect(arguments, observation, calibration, SensorKind::kStereo);
}

void DetectRgbd(const DetectArguments& arguments) {
  RecordedObservation recorded = ReadObservation({.sensor = SensorKind::kRgbd,
                                                  .left = {},
                                                  .right = {},
                                                  .color = arguments.color,
                                                  .depth = arguments.depth,
                                                  .calibration = arguments.calibration});
  if (arguments.depth_scale > 0.0) {
    const double unit_m = 1.0 / arguments.depth_scale;
    if (const auto objection = DepthUnitObjection(unit_m)) {
      throw InputError("--depth-scale",
                       fmt::format("{:g} units per metre: {}. Other programs call metres per unit "
                                   "the scale: 0.001 would be 1000 here",
                                   arguments.depth_scale, *objection));
    }
    std::get<RgbdCalibration>(recorded.calibration).depth_unit_m = unit_m;
    std::get<RgbdObservation>(recorded.observation).depth.unit_m = unit_m;
  } else {
    NoteAssumedDepthUnit(arguments.calibration);
  }
  Detect(arguments, recorded.observation, recorded.calibration, SensorKind::kRgbd);
}

void AddCommonOptions(Command command, DetectArguments& arguments,
                      const std::string& default_detector) {
  arguments.detector.detector = default_detector;
  command.AddOption("--calibration", arguments.calibration, "Calibration file (YAML)").Required();
  AddDetectorOptions(command, arguments.detector);
  command.AddFlag("--json", arguments.json, "Print JSON");
  command.AddOption("--pictures", arguments.pictures, "Folder for the pictures of every stage");
}

}  // namespace

void AddDetectCommand(Command program) {
  Command detect = program.AddCommand("detect", "Runs a detector on recorded image files");
  detect.RequireCommand();
  detect.Footer(
      "Example:\n"
      "  fenestra detect stereo --left L.png --right R.png --calibration stereo.yaml --json\n"
      "  fenestra detect stereo --left L.png --right R.png --calibration stereo.yaml "
      "--command '[python3, mine.py]'");

  Command stereo = detect.AddCommand("stereo", "On a pair of grey images");
  const auto stereo_arguments = std::make_shared<DetectArguments>();
  stereo.AddOption("--left", stereo_arguments->left, "Left image, 8-bit grey").Required();
  stereo.AddOption("--right", stereo_arguments->right, "Right image, 8-bit grey").Required();
  AddCommonOptions(stereo, *stereo_arguments, "paper-stereo");
  stereo.Footer(
      "Example:\n"
      "  fenestra detect stereo --left L.png --right R.png --calibration stereo.yaml "
      "--pictures /tmp/stages");
  stereo.Action([stereo_arguments] {
    DetectStereo(*stereo_arguments);
    return kDone;
  });

  Command rgbd = detect.AddCommand("rgbd", "On a colour image and a depth image");
  const auto rgbd_arguments = std::make_shared<DetectArguments>();
  rgbd.AddOption("--color", rgbd_arguments->color, "Colour image, 8 bits").Required();
  rgbd.AddOption("--depth", rgbd_arguments->depth, "Depth image, 16 bits, 0: no return").Required();
  rgbd.AddOption("--depth-scale", rgbd_arguments->depth_scale,
                 "Units per metre; default: as the calibration says")
      .Positive();
  AddCommonOptions(rgbd, *rgbd_arguments, "paper-rgbd");
  rgbd.Footer(
      "Example:\n"
      "  fenestra detect rgbd --color C.png --depth D.png --depth-scale 5000 "
      "--calibration rgbd.yaml");
  rgbd.Action([rgbd_arguments] {
    DetectRgbd(*rgbd_arguments);
    return kDone;
  });
}

}  // namespace fenestra::cli
