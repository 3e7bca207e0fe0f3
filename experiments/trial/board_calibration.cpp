#include "experiments/trial/board_calibration.h"

#include <fmt/format.h>

#include "core/geometry/calibration.h"
#include "core/io/input_error.h"

namespace fenestra {
namespace {

std::string ContentOf(const StereoRigOptions& o) {
  const LensOptions& lens = o.lens;
  const SpectralOptions& spectrum = o.spectrum;
  const ImageSensorOptions& s = o.sensor;
  const ExposureOptions& e = o.exposure;
  return fmt::format("lens {} {} {} {} {}\n", lens.f_number, lens.transmission, lens.blur_sigma_px,
                     lens.corner_blur_sigma_px, lens.corner_illumination) +
         fmt::format("spectrum {} {} {} pitch {}\n", static_cast<int>(spectrum.illuminant),
                     spectrum.cut_off_nm, spectrum.quantum_efficiency_scale, o.pixel_pitch_m) +
         fmt::format("sensor {} {} {} {} {} {} {} {} {} {} {} {} {}\n", s.saturation_e,
                     s.read_noise_e, s.dark_current_e_s, s.dark_current_doubling_k, s.temperature_c,
                     s.dsnu_e, s.prnu, s.row_noise_e, s.adc_bits, s.output_bits, s.black_level_dn,
                     s.noise, s.fixed_pattern) +
         fmt::format("exposure {} {} {} {} {} {} {}\n", e.automatic, e.set_point, e.exposure_s,
                     e.gain, e.shortest_s, e.longest_s, e.largest_gain) +
         fmt::format("edge samples {}\n", o.edge_samples_per_pixel);
}

std::string PoseText(const Pose& X) {
  const Eigen::Matrix3d R = X.rotation();
  const Eigen::Vector3d t = X.translation();
  return fmt::format("{} {} {}\n", fmt::join(R.data(), R.data() + 9, " "), fmt::join(t, " "),
                     t.norm());
}

}  // namespace

StereoCalibrationResult CalibrateWithBoards(const StereoRig& rig,
                                            const BoardSessionOptions& session,
                                            const RandomStream& stream) {
  Validate(session);
  const BoardWorld world(session.board);
  std::vector<NamedView> views;
  for (int i = 0; i < session.views; ++i) {
    const RandomStream view = stream.Child("view", static_cast<uint64_t>(i));
    const StereoObservation seen = ShootBoard(rig, world, session, view);
    const BoardSighting left = FindBoard(seen.left, session.board);
    const BoardSighting right = FindBoard(seen.right, session.board);
    const auto corners = [](const BoardSighting& sighting) {
      const auto* found = std::get_if<std::vector<BoardCorner>>(&sighting);
      return found != nullptr ? *found : std::vector<BoardCorner>();
    };
    views.push_back({fmt::format("view {}", i), {corners(left), corners(right)}});
  }
  const cv::Size size(rig.options().width_px, rig.options().height_px);
  return CalibrateStereo(views, session.board,
                         {.left_size = size,
                          .right_size = size,
                          .adjustment = {.free_k3 = rig.options().distortion.k3 != 0.0}});
}

std::string ContentOf(const StereoRig& rig, const BoardSessionOptions& session,
                      const RandomStream& stream) {
  const CalibrationBoard& b = session.board;
  return ToOpenCvYaml(rig.cameras()) + PoseText(rig.X_BL()) + ContentOf(rig.options()) +
         fmt::format("pattern {:016x}\n", rig.pattern_key()) +
         fmt::format("baseline {} focal length {}\n", rig.options().baseline_m,
                     rig.options().focal_length_m) +
         fmt::format("board {} {} {} {} {}\n", static_cast<int>(b.kind), b.columns, b.rows,
                     b.square_m, b.marker_m) +
         fmt::format("session {} {} {} {} {} {}\n", session.views, session.illuminance_lx,
                     session.smallest_share, session.largest_share, session.largest_tilt_rad,
                     session.largest_roll_rad) +
         fmt::format("stream {:016x}\n", stream.key());
}

}  // namespace fenestra
