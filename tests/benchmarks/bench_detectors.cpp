// How long the detectors take on simulated observations, beside the library calls that they cannot
// do without. On one core, whatever the machine has.
//   bench_detectors --benchmark_min_time=1 --benchmark_repetitions=5

#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>

#include "experiments/study_file/study_catalogue.h"
#include "experiments/study_file/study_reader.h"
#include "experiments/trial/cell_runner.h"
#include "vision/detector_registry.h"
#include "vision/rgbd/paper/cloud_shape.h"
#include "vision/rgbd/paper/narf_key_points.h"
#include "vision/rgbd/paper/paper_rgbd.h"
#include "vision/stereo/paper/paper_stereo.h"

namespace fenestra {
namespace {

/// Trial 0 of the paper's study, in the part and at the distance that are asked for.
SimulatedTrial PaperTrial(const std::string& part, double distance_m) {
  YamlReader reader = YamlReader::FromFile(FindStudy("paper"));
  const Study study = ReadStudy(reader, Detectors());
  for (const Cell& cell : Cells(study)) {
    if (cell.part != part) continue;
    for (const auto& [name, value] : cell.levels) {
      if (name == "distance_m" && value == ParameterValue(distance_m)) {
        return CellRunner(study, cell).Simulate(0);
      }
    }
  }
  FENESTRA_CHECK(false, "the paper's study has no such cell");
}

SimulatedTrial StereoTrial(const benchmark::State& state) {
  return PaperTrial("stereo", static_cast<double>(state.range(0)));
}

// The argument is in centimetres; at 0.78 m the paper's small square, else the 1 m one.
SimulatedTrial RgbdTrial(const benchmark::State& state) {
  const double distance_m = static_cast<double>(state.range(0)) / 100.0;
  return PaperTrial(distance_m < 1.0 ? "near" : "rgbd", distance_m);
}

void RunDetector(benchmark::State& state, const std::string& name, const SimulatedTrial& trial) {
  cv::setNumThreads(1);
  const auto detector = MakeDetector(name, trial.calibration, {});
  bool found = false;
  for (auto _ : state) {
    StageLog log(SteadyClock());
    const Detection detection = detector->Detect(trial.observation, log);
    found = std::holds_alternative<WindowEstimate>(detection);
  }
  state.SetLabel(found ? "found" : "missed");
}

// cv::StereoBM on the rectified and padded pair with paper-stereo's settings.
void BM_BareStereoBM(benchmark::State& state) {
  cv::setNumThreads(1);
  const SimulatedTrial trial = StereoTrial(state);
  const PaperStereoOptions options;
  const auto& calibration = std::get<StereoCalibration>(trial.calibration);
  const StereoRectification rectification(calibration, options.rectification_alpha);
  const RectifiedPair pair = rectification.Rectify(std::get<StereoObservation>(trial.observation));
  const BlockMatchingSettings settings =
      MatchingSettings(options, rectification.camera(), pair.left.cols);
  for (auto _ : state) benchmark::DoNotOptimize(MatchPadded(pair, settings));
}

void BM_PaperStereo(benchmark::State& state) {
  RunDetector(state, "paper-stereo", StereoTrial(state));
}

void BM_EdgeStereo(benchmark::State& state) {
  RunDetector(state, "edge-stereo", StereoTrial(state));
}

// PCL's NARF on the range image of paper-rgbd, with its settings.
void BM_BareNarf(benchmark::State& state) {
  const SimulatedTrial trial = RgbdTrial(state);
  const PaperRgbdOptions options;
  const auto& calibration = std::get<RgbdCalibration>(trial.calibration);
  const DepthRegistration registration(calibration);
  const CameraModel& camera = registration.working_camera();
  const DarkCloud cloud =
      SegmentDark(registration.Register(std::get<RgbdObservation>(trial.observation)), camera,
                  options.dark_below_dn);
  const auto shape = ShapeOf(cloud.points_K, ToleranceOf(options), RandomStream(1));
  FENESTRA_CHECK(shape.has_value(), "a cloud with a plane");
  const int stride = RangeImageStride(camera, options);
  const NarfRangeImage range_image(cloud.depth_m, camera, stride, options.unseen_is_far);
  const NarfSettings settings{.support_size_m = SupportSize(*shape, camera, options),
                              .min_interest_value = options.min_interest_value};
  for (auto _ : state) benchmark::DoNotOptimize(range_image.DetectKeyPoints(settings));
}

void BM_PaperRgbd(benchmark::State& state) {
  RunDetector(state, "paper-rgbd", RgbdTrial(state));
}

void BM_PlaneRgbd(benchmark::State& state) {
  RunDetector(state, "plane-rgbd", RgbdTrial(state));
}

#define FENESTRA_STEREO(name) \
  BENCHMARK(name)->ArgName("m")->Arg(2)->Arg(3)->Arg(6)->Unit(benchmark::kMillisecond)
#define FENESTRA_RGBD(name) \
  BENCHMARK(name)->ArgName("cm")->Arg(78)->Arg(140)->Arg(200)->Unit(benchmark::kMillisecond)

FENESTRA_STEREO(BM_BareStereoBM);
FENESTRA_STEREO(BM_PaperStereo);
FENESTRA_STEREO(BM_EdgeStereo);
FENESTRA_RGBD(BM_BareNarf);
FENESTRA_RGBD(BM_PaperRgbd);
FENESTRA_RGBD(BM_PlaneRgbd);

}  // namespace
}  // namespace fenestra

BENCHMARK_MAIN();
