// What a calibration of the default rig with 20 boards leaves, cause by cause, to first order; not
// a test: docs/stereo.md has its output.

#include <fmt/format.h>

#include <cmath>

#include "experiments/trial/board_theory.h"
#include "experiments/trial/calibrated_rig.h"

namespace {

using namespace fenestra;

// Derivative of the depth [m] that a calibration gives to a point on the axis, by PairVector. Depth
// is f b / (d - d₀) with the disparity d₀ of the far point, in the centre c_l - c_r - f × yaw.
PairVector DepthGradient(double z_m, double focal_px, double baseline_m) {
  PairVector g = PairVector::Zero();
  const double by_disparity = z_m * z_m / (focal_px * baseline_m);
  g[0] = 0.5 * z_m / focal_px;
  g[kCameraParameters] = 0.5 * z_m / focal_px;
  g[2] = by_disparity;
  g[kCameraParameters + 2] = -by_disparity;
  g[2 * kCameraParameters + 1] = -focal_px * by_disparity;
  g[2 * kCameraParameters + 3] = -z_m / baseline_m;
  return g;
}

void Print(const char* cause, const CalibrationChoice& choice) {
  StereoRigOptions options;
  options.as_designed = true;
  const StereoRig rig(options, RandomStream(0));
  const PairMatrix covariance = CalibrationCovariance(rig, choice, {}).value();
  const double focal_px = rig.cameras().left.parameters().fx_px;
  const auto deviation = [&](const PairVector& by) { return std::sqrt(by.dot(covariance * by)); };
  const PairVector of_depth = DepthGradient(1.0, focal_px, options.baseline_m);
  PairVector of_disparity = focal_px * options.baseline_m * of_depth;
  of_disparity[0] = of_disparity[kCameraParameters] = 0.0;
  of_disparity[2 * kCameraParameters + 3] = 0.0;
  fmt::print("{:28} {:8.2g} {:8.2g} {:8.3f}", cause, std::sqrt(covariance(0, 0)) / focal_px,
             std::sqrt(covariance(21, 21)) / options.baseline_m, deviation(of_disparity));
  for (const double z_m : {2.0, 4.0, 10.0}) {
    fmt::print(" {:8.3g}", 1e3 * deviation(DepthGradient(z_m, focal_px, options.baseline_m)));
  }
  fmt::print("\n");
}

}  // namespace

int main() {
  const CalibrationChoice all;
  CalibrationChoice none = all;
  none.board_tolerances = kAsDrawn;
  none.corner_noise_px = none.rotation_error_rad = none.translation_error_m = 0.0;
  fmt::print("{:28} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "cause", "f", "baseline", "d0 [px]",
             "2 m [mm]", "4 m", "10 m");
  CalibrationChoice one = none;
  one.corner_noise_px = all.corner_noise_px;
  Print("corner noise 0.05 px", one);
  one = none;
  one.board_tolerances.bow = all.board_tolerances.bow;
  Print("bow and twist", one);
  one = none;
  one.board_tolerances.line_error = all.board_tolerances.line_error;
  Print("lines", one);
  one = none;
  one.board_tolerances.print_scale = all.board_tolerances.print_scale;
  one.board_tolerances.print_anisotropy = all.board_tolerances.print_anisotropy;
  Print("scale and anisotropy", one);
  one = none;
  one.rotation_error_rad = all.rotation_error_rad;
  one.translation_error_m = all.translation_error_m;
  Print("drift 0.1 mrad, 0.1 mm", one);
  Print("all: perturbed", all);
}
