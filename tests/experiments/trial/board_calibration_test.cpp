#include "experiments/trial/board_calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

StereoRigOptions SmallImages() {
  StereoRigOptions options;
  options.width_px = 64;
  options.height_px = 48;
  options.focal_length_m = 4e-4;  // The same view, in a tenth of the pixels' number along a side.
  return options;
}

TEST(BoardCalibrationTest, BoardsTellTheRigToWhatTheirCovarianceSays) {
  const StereoRig rig({}, RandomStream(1));
  BoardSessionOptions session;
  session.views = 8;
  const StereoCalibrationResult result = CalibrateWithBoards(rig, session, RandomStream(3));
  EXPECT_TRUE(result.left_out.empty());
  const PairVector error = PairError(result.calibration, rig.cameras());
  for (int i = 0; i < kPairParameters; ++i) {
    const double sigma = std::sqrt(result.covariance(i, i));
    // Normal: 5 of them are exceeded once in 10⁵ by any of 22 parameters; fixed ones do not err.
    EXPECT_LE(std::abs(error[i]), 5.0 * sigma) << PairParameterNames()[static_cast<size_t>(i)];
  }
  // A covariance ten times too large would pass above. The pixels alone say how good it has to be:
  // corners to 0.01 px, some 400 of them, leave a focal length of 667 px to well below one.
  EXPECT_LT(std::sqrt(result.covariance(0, 0)), 1.0);
  EXPECT_LT(result.rms_px, 0.1);
  // The twin: the rig as designed is no calibration.
  const PairVector design = PairError(DesignOf(rig.options()), rig.cameras());
  const PairVector deviation = result.covariance.diagonal().cwiseSqrt();
  EXPECT_GT(design.cwiseAbs()[0], 5.0 * deviation[0]);
}

TEST(BoardCalibrationTest, ContentTellsWhateverTheResultDependsOn) {
  const StereoRig rig(SmallImages(), RandomStream(1));
  const BoardSessionOptions session;
  const RandomStream stream(2);
  std::vector<std::string> contents = {ContentOf(rig, session, stream)};
  EXPECT_EQ(contents[0], ContentOf(StereoRig(SmallImages(), RandomStream(1)), session, stream));
  contents.push_back(ContentOf(rig, session, RandomStream(3)));
  contents.push_back(ContentOf(StereoRig(SmallImages(), RandomStream(7)), session, stream));

  using Rig = StereoRigOptions;
  for (const auto& change : std::vector<void (*)(Rig&)>{
           [](Rig& o) { o.width_px += 1; },
           [](Rig& o) { o.height_px += 1; },
           [](Rig& o) { o.pixel_pitch_m *= 1.01; },
           [](Rig& o) { o.focal_length_m *= 1.01; },
           [](Rig& o) { o.baseline_m *= 1.01; },
           [](Rig& o) { o.distortion.k1 *= 1.01; },
           [](Rig& o) { o.distortion.k3 = 1e-4; },
           [](Rig& o) { o.lens.f_number *= 1.01; },
           [](Rig& o) { o.lens.transmission *= 0.99; },
           [](Rig& o) { o.lens.blur_sigma_px *= 1.01; },
           [](Rig& o) { o.lens.corner_blur_sigma_px *= 1.01; },
           [](Rig& o) { o.lens.corner_illumination *= 0.99; },
           [](Rig& o) { o.spectrum.illuminant = Illuminant::kIncandescent; },
           [](Rig& o) { o.spectrum.cut_off_nm += 1.0; },
           [](Rig& o) { o.spectrum.quantum_efficiency_scale *= 1.01; },
           [](Rig& o) { o.sensor.saturation_e *= 1.01; },
           [](Rig& o) { o.sensor.read_noise_e *= 1.01; },
           [](Rig& o) { o.sensor.dark_current_e_s *= 1.01; },
           [](Rig& o) { o.sensor.dark_current_doubling_k *= 1.01; },
           [](Rig& o) { o.sensor.temperature_c += 1.0; },
           [](Rig& o) { o.sensor.dsnu_e *= 1.01; },
           [](Rig& o) { o.sensor.prnu *= 1.01; },
           [](Rig& o) { o.sensor.row_noise_e *= 1.01; },
           [](Rig& o) { o.sensor.adc_bits = 12; },
           [](Rig& o) { o.sensor.output_bits = 10; },
           [](Rig& o) { o.sensor.black_level_dn += 1.0; },
           [](Rig& o) { o.sensor.noise = false; },
           [](Rig& o) { o.sensor.fixed_pattern = false; },
           [](Rig& o) { o.exposure.automatic = false; },
           [](Rig& o) { o.exposure.set_point *= 1.01; },
           [](Rig& o) { o.exposure.exposure_s *= 1.01; },
           [](Rig& o) { o.exposure.gain *= 1.01; },
           [](Rig& o) { o.exposure.shortest_s *= 1.01; },
           [](Rig& o) { o.exposure.longest_s *= 1.01; },
           [](Rig& o) { o.exposure.largest_gain *= 1.01; },
           [](Rig& o) { o.as_designed = true; },
           [](Rig& o) { o.tolerances.rotation_rad *= 1.01; },
           [](Rig& o) { o.edge_samples_per_pixel = 64; }}) {
    StereoRigOptions options = SmallImages();
    change(options);
    contents.push_back(ContentOf(StereoRig(options, RandomStream(1)), session, stream));
  }
  using Session = BoardSessionOptions;
  for (const auto& change : std::vector<void (*)(Session&)>{
           [](Session& o) { o.board.kind = BoardKind::kCharuco; },
           [](Session& o) { o.board.columns += 2; }, [](Session& o) { o.board.rows += 2; },
           [](Session& o) { o.board.square_m *= 1.01; },
           [](Session& o) { o.board.marker_m *= 1.01; }, [](Session& o) { o.views -= 1; },
           [](Session& o) { o.illuminance_lx *= 1.01; },
           [](Session& o) { o.smallest_share *= 1.01; },
           [](Session& o) { o.largest_share *= 1.01; },
           [](Session& o) { o.largest_tilt_rad *= 1.01; },
           [](Session& o) { o.largest_roll_rad *= 1.01; }}) {
    BoardSessionOptions other = session;
    change(other);
    contents.push_back(ContentOf(rig, other, stream));
  }
  std::sort(contents.begin(), contents.end());
  EXPECT_EQ(std::adjacent_find(contents.begin(), contents.end()), contents.end());
}

TEST(BoardCalibrationTest, ARigThatMovesIsCalibratedStandingStill) {
  StereoRigOptions moving = SmallImages();
  moving.trigger_skew_s = 1e-3;
  EXPECT_EQ(ContentOf(StereoRig(moving, RandomStream(1)), {}, RandomStream(2)),
            ContentOf(StereoRig(SmallImages(), RandomStream(1)), {}, RandomStream(2)));
}

}  // namespace
}  // namespace fenestra
