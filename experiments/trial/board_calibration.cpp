#include "experiments/trial/board_calibration.h"

#include <fmt/format.h>

#include "core/geometry/calibration.h"
#include "core/io/input_error.h"
#include "experiments/study/factors.h"

namespace fenestra {

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

std::string ContentOf(const StereoRig& rig, const CalibrationChoice& choice,
                      const RandomStream& stream) {
  // What the boards do not see keeps its default: how the rig flies, and what comes after.
  TrialSettings settings;
  settings.stereo = rig.Still().options();
  settings.stereo_calibration.boards = choice.boards;
  settings.stereo_calibration.board = choice.board;
  std::string content = ToOpenCvYaml(rig.cameras()) + fmt::format("rig {:016x} boards {:016x}\n",
                                                                  rig.pattern_key(), stream.key());
  for (const ParameterInfo& info : Factors().infos()) {
    if (GroupOf(info.name) != FactorGroup::kStereo) continue;
    content += fmt::format("{}: {}\n", info.name, ToString(Factors().Get(settings, info.name)));
  }
  return content;
}

}  // namespace fenestra
