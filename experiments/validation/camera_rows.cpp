#include "experiments/validation/validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "experiments/emva/evaluation.h"
#include "experiments/emva/simulated_series.h"
#include "experiments/rig_calibration/board_pictures.h"
#include "experiments/trial/calibrated_rig.h"

namespace fenestra::validation {
namespace {

// The squares of the recorded board, of 9 x 6 inner corners, as its source has them.
CalibrationBoard RecordedBoard() {
  return {
      .kind = BoardKind::kChessboard, .columns = 10, .rows = 7, .square_m = 0.03, .marker_m = 0.0};
}

StereoCalibrationResult CalibrateRecorded(const std::filesystem::path& recordings) {
  const std::string folder = (recordings / "stereo-calibration").string();
  return CalibrateFromPictures(
      PairUp(ImageFiles({folder + "/left*.jpg"}), ImageFiles({folder + "/right*.jpg"})),
      RecordedBoard(), {});
}

// Standard deviations that a calibration states, relative.
double StatedFocal(const StereoCalibrationResult& result) {
  return std::sqrt(result.covariance(0, 0)) / result.calibration.left.parameters().fx_px;
}
double StatedBaseline(const StereoCalibrationResult& result) {
  const Eigen::Vector3d shift = result.calibration.X_RL.translation();
  const Eigen::Vector3d along = shift.normalized();
  constexpr int kShift = 2 * kCameraParameters + 3;
  return std::sqrt(along.dot(result.covariance.block<3, 3>(kShift, kShift) * along)) / shift.norm();
}

// How far the RMS of single recorded views lies from that of all, as a standard deviation of its
// logarithm.
double ScatterOfViews(const StereoCalibrationResult& result) {
  double squares = 0.0;
  for (const ViewResiduals& view : result.views) {
    for (const double rms_px : {view.left_rms_px, view.right_rms_px}) {
      squares += std::pow(std::log(rms_px / result.rms_px), 2);
    }
  }
  return std::sqrt(squares / (2.0 * static_cast<double>(result.views.size())));
}

// A figure that is known to its last decimal: half of that either way.
struct Rounded {
  double value;
  double half_unit;
};

Row PhotonTransferRow(const std::string& phenomenon, const Rounded& recorded, double simulated,
                      const std::string& unit) {
  Row row{.phenomenon = "MT9V034: " + phenomenon,
          .recording = "8-bit images, which may not be handed on: figures without a file",
          .recorded = fmt::format("{} {}", recorded.value, unit),
          .simulated = fmt::format("{:.3g} {}", simulated, unit),
          .origin = Origin::kFitted};
  JudgeRange(row, simulated, recorded.value - recorded.half_unit,
             recorded.value + recorded.half_unit, unit);
  return row;
}

// Mean and temporal variance of a uniformly lit image [DN, DN²], by two images.
struct GreyLevel {
  double mean;
  double variance;
};
GreyLevel Expose(const ImageSensor& sensor, const ExposureSetting& exposure, double electrons) {
  const cv::Mat1f light(sensor.size(), static_cast<float>(electrons / exposure.exposure_s));
  const RandomStream noise(3);
  cv::Mat1d first;
  cv::Mat1d second;
  sensor.Expose(light, exposure, noise.Child("first")).convertTo(first, CV_64F);
  sensor.Expose(light, exposure, noise.Child("second")).convertTo(second, CV_64F);
  const cv::Mat1d difference = first - second;
  return {cv::mean(0.5 * (first + second))[0], 0.5 * cv::mean(difference.mul(difference))[0]};
}

// At the exposure that gives this grey, by bisection.
GreyLevel AtGrey(const ImageSensor& sensor, const ExposureSetting& exposure, double grey) {
  double low = 0.0;
  double high = sensor.FullScaleElectrons(exposure.gain);
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    (Expose(sensor, exposure, middle).mean < grey ? low : high) = middle;
  }
  return Expose(sensor, exposure, low);
}

}  // namespace

std::vector<Row> CalibrationRows(const std::filesystem::path& recordings) {
  const StereoCalibrationResult recorded = CalibrateRecorded(recordings);
  BoardSessionOptions session;
  session.views = static_cast<int>(recorded.views.size());
  const StereoCalibrationResult simulated =
      CalibrateWithBoards(StereoRig({}, RandomStream(1)), session, {}, RandomStream(2));
  const double tau = ScatterOfViews(recorded);
  std::vector<Row> rows;
  const auto add = [&](const char* phenomenon, double real, double ours, double scale,
                       const char* unit) {
    Row row{.phenomenon = fmt::format("calibration by boards: {}", phenomenon),
            .recording = "stereo-calibration (Learning OpenCV 3, BSD-2), 13 pairs",
            .recorded = fmt::format("{:.3g} {}", scale * real, unit),
            .simulated = fmt::format("{:.3g} {}", scale * ours, unit),
            .origin = Origin::kFitted};
    JudgeRatio(row, {real, 0.0}, {ours, 0.0}, tau);
    rows.push_back(std::move(row));
  };
  add("deviation of a corner's coordinate", recorded.corner_deviation_px,
      simulated.corner_deviation_px, 1.0, "px");
  add("stated deviation of the focal length", StatedFocal(recorded), StatedFocal(simulated), 1e6,
      "ppm");
  add("stated deviation of the baseline", StatedBaseline(recorded), StatedBaseline(simulated), 1e6,
      "ppm");
  return rows;
}

std::vector<Row> PhotonTransferRows(const ImageSensorOptions& options) {
  constexpr ExposureSetting kExposure{.exposure_s = 2e-3, .gain = 2.0};  // As image_sensor.h says.
  const ImageSensor sensor(options, {320, 240}, RandomStream(1));
  const GreyLevel dim = AtGrey(sensor, kExposure, 12.0);
  const GreyLevel knee = AtGrey(sensor, kExposure, 170.0);
  const GreyLevel bright = AtGrey(sensor, kExposure, 215.0);
  Row flat = PhotonTransferRow("variance at grey 215 over that at 170", {1.0, 0.15},
                               bright.variance / knee.variance, "");
  flat.recorded = "flat";
  return {
      PhotonTransferRow("grey in the dark", {10.0, 0.5}, Expose(sensor, kExposure, 0.0).mean, "DN"),
      PhotonTransferRow("variance at grey 12", {0.5, 0.05}, dim.variance, "DN²"),
      PhotonTransferRow("slope of the variance from grey 12 to 170", {0.03, 0.005},
                        (knee.variance - dim.variance) / (knee.mean - dim.mean), "DN²/DN"),
      flat};
}

std::vector<Row> EmvaRows(const ImageSensorOptions& options) {
  ImageSensorOptions sensor = options;
  sensor.output_bits = sensor.adc_bits;  // 8 bits hide the dark noise.
  emva::SimulationOptions simulation;
  simulation.size = {320, 240};
  const emva::PutIn put_in = emva::PutInBy(simulation, sensor);
  const emva::Results found = emva::Evaluate(emva::PlanSeries(simulation, sensor),
                                             emva::Simulate(simulation, sensor, RandomStream(1)));
  std::vector<Row> rows;
  const auto add = [&rows](const char* phenomenon, double put, double measured, double scale,
                           const char* unit, double percent) {
    Row row{.phenomenon = fmt::format("EMVA 1288: {}", phenomenon),
            .recording = "none: what was put in",
            .recorded = fmt::format("{:.4g} {}", scale * put, unit),
            .simulated = fmt::format("{:.4g} {}", scale * measured, unit),
            .origin = Origin::kDesign};
    const double off = 100.0 * (measured / put - 1.0);
    row.agreement = fmt::format("{:+.1f} % of ± {:g} %", off, percent);
    row.verdict = std::abs(off) <= percent ? Verdict::kHolds : Verdict::kMisfit;
    rows.push_back(std::move(row));
  };
  add("system gain", put_in.gain_dn_per_e, found.gain_dn_per_e, 1.0, "DN/e", 2.0);
  add("quantum efficiency", put_in.quantum_efficiency, found.quantum_efficiency, 100.0, "%", 2.0);
  add("temporal dark noise", put_in.dark_noise_e, found.dark_noise_e, 1.0, "e", 5.0);
  add("DSNU", put_in.dsnu_e, found.dsnu_e.total, 1.0, "e", 10.0);
  add("PRNU", put_in.prnu, found.prnu.total, 100.0, "%", 10.0);
  if (put_in.saturation_e) {
    add("saturation", *put_in.saturation_e, found.saturation_e, 1.0, "e", 3.0);
  }
  return rows;
}

Row CyclesRow(const std::filesystem::path& results) {
  Row row{.phenomenon = "renderer: depth and radiance",
          .recording = "none: Blender's Cycles (tests/peers)",
          .recorded = "—",
          .simulated = "—",
          .origin = Origin::kPredicted,
          .agreement = "no result"};
  std::ifstream file(results);
  bool of_cycles = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) of_cycles = line == "## cycles";
    if (!of_cycles) continue;
    const bool agrees = line.ends_with(": agrees.");
    if (!agrees && !line.ends_with(": DISAGREES.")) continue;
    row.agreement = line;
    row.verdict = agrees ? Verdict::kHolds : Verdict::kMisfit;
  }
  return row;
}

}  // namespace fenestra::validation
